// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/endpoint.h"
#include "core/log/time.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace posewire::model {
class SessionView;
} // namespace posewire::model

namespace posewire::outlets {

/// Figures of the program itself, which the session does not know.
struct OwnFigures {
    std::optional<double> bufferFill{}; ///< share of the fullest receive buffer, the most since before
    std::uint64_t refusedDatagrams = 0; ///< from hosts that are not listened to
    std::optional<double> cpuSeconds{}; ///< of all threads, since the start
    std::optional<std::uint64_t> memoryBytes{}; ///< of this process
};

/// Serves the figures of a session over HTTP, in the text format of Prometheus, on threads of its own. A
/// scrape gets the figures of the last update and never touches the session. Not on Windows.
class Metrics {
public:
    static constexpr log::Duration kPeriod = std::chrono::seconds(1);

    /// `place` is "ADDRESS:PORT", or "PORT" for this computer alone; port 0 is one that is free.
    [[nodiscard]] static net::NetResult<std::unique_ptr<Metrics>> serve(const std::string& place,
                                                                        std::string version);
    ~Metrics();
    Metrics(const Metrics&) = delete;
    Metrics& operator=(const Metrics&) = delete;

    /// "http://127.0.0.1:9464/metrics"
    [[nodiscard]] std::string address() const { return "http://" + m_place + "/metrics"; }
    /// True if a period has passed since the last update.
    [[nodiscard]] bool isDue(log::Stamp now) const { return !m_updated || now - *m_updated >= kPeriod; }
    /// Reads the live session as it is now. From the thread that has it follow the log, when it is due.
    void update(const model::SessionView& session, const OwnFigures& own);

private:
    struct Parts;
    Metrics(std::unique_ptr<Parts> parts, std::string place);

    std::unique_ptr<Parts> m_parts;
    std::string m_place;
    std::optional<log::Stamp> m_updated;
};

} // namespace posewire::outlets
