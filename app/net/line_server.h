// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/endpoint.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace posewire::net {

/// Sends lines of text to all who connect, by TCP or by a Unix socket (a named pipe on Windows). What they
/// send is not read. Belongs to one thread, which processes Qt's events.
class LineServer {
public:
    static constexpr std::size_t kMostReceivers = 32;
    /// Bytes: a receiver that has left more unread gets no lines until it reads again.
    static constexpr std::int64_t kMostUnread = std::int64_t{1} << 20;

    /// `place` is "unix:PATH", "ADDRESS:PORT", or "PORT" for this computer alone; port 0 is one that is free.
    [[nodiscard]] static NetResult<std::unique_ptr<LineServer>> listen(const std::string& place);
    ~LineServer();
    LineServer(const LineServer&) = delete;
    LineServer& operator=(const LineServer&) = delete;

    /// Never waits. `line` ends without a newline.
    void send(const std::string& line);

    /// As to be connected to: "127.0.0.1:9800", "unix:/run/poses".
    [[nodiscard]] const std::string& place() const;
    [[nodiscard]] std::size_t receivers() const;
    /// Lines, of all receivers: how many were sent, and how many were left out because those before had not
    /// been read.
    [[nodiscard]] std::uint64_t sent() const;
    [[nodiscard]] std::uint64_t skipped() const;

private:
    struct Parts;
    explicit LineServer(std::unique_ptr<Parts> parts);

    std::unique_ptr<Parts> m_parts;
};

} // namespace posewire::net
