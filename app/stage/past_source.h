// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/stage/batch.h"
#include "app/stage/batch_order.h"
#include "app/stage/server.h"
#include "core/log/byte_io.h"
#include "core/log/time.h"

#include <memory>
#include <string>

namespace posewire::stage {

/// Reads, as a recording, the packets that the probes of a site received in a range of time, as long as the
/// stream keeps them. Senders have the name of their probe. Packets come in the order in which they were
/// stored: late if a probe had to wait for a server. Reading ends five minutes of storing after the range.
class PastSource final : public log::ByteSource {
public:
    /// Fails if no server answers, or none has a stream of the site.
    static net::NetResult<std::unique_ptr<PastSource>> open(const ServerChoice& servers,
                                                            const std::string& site, log::WallTime since,
                                                            log::WallTime until,
                                                            log::IsCancelled isCancelled);

    tl::expected<std::size_t, log::FileError> read(std::span<std::byte> into) override;
    [[nodiscard]] std::string name() const override { return m_site + " on " + m_server->place(); }

private:
    PastSource(std::unique_ptr<Server> server, std::string site)
        : m_server(std::move(server)), m_site(std::move(site)) {}
    /// Fills the batch with the packets of the range in the next message. Returns false at the end.
    tl::expected<bool, log::FileError> fetch();

    std::unique_ptr<Server> m_server;
    std::string m_site;
    log::WallTime m_since{};
    log::WallTime m_until{};
    log::IsCancelled m_isCancelled;
    std::uint64_t m_next = 0; ///< message; 0 for the first one of the time
    std::uint64_t m_last = 0; ///< when reading began
    bool m_hasSome = false;   ///< a message has come
    Subscription m_batches;
    BatchOrder m_order;
    Batch m_batch;
    std::size_t m_read = 0; ///< bytes of it
};

} // namespace posewire::stage
