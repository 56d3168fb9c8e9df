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

/// What the probes of a site received from one time to another, as far as a stream has it: read like a
/// recording, with the name of the probe in each sender. In the order in which it was stored, which is not
/// that of time where a probe had to wait for a server. What was stored more than five minutes after the end
/// is not looked for.
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
    /// Fills the batch with what the next message has of the time; false where there is no more.
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
