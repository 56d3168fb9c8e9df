// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/command.h"
#include "app/net/receiver.h"
#include "core/model/accounting/stream_figures.h"

#include <array>

namespace posewire::cli {

/// A figure that may be limited: `--max-NAME`.
struct Limit {
    std::string_view name;
    model::Figure figure;
    std::string_view help;
};
inline constexpr std::array<Limit, 3> kLimits{
    {{"loss", model::Figure::LossShare, "samples lost or incomplete"},
     {"jitter", model::Figure::Jitter, "jitter as in RFC 3550"},
     {"gap", model::Figure::SpacingMost, "time between successive samples"}}};

/// " %" or " ms", as it follows a number.
[[nodiscard]] std::string unitOf(const Limit& limit);

/// The most that a stream may have of each of kLimits; nothing: anything.
struct Limits {
    std::array<std::optional<double>, kLimits.size()> most;
    [[nodiscard]] bool isAny() const;
};

/// What `monitor` was asked for, as typed.
struct MonitorOptions {
    std::string file; ///< empty: the network
    std::vector<std::string> udp;
    std::vector<std::string> multicast;
    std::vector<std::string> tcpListen;
    std::vector<std::string> tcp;
    double durationSeconds = 0; ///< 0: until interrupted
    double intervalSeconds = 1;
    std::string record; ///< empty: not
    std::string report; ///< empty: none
    bool asJson = false;
    bool isQuiet = false;              ///< neither tables nor JSON, only the report
    std::optional<double> fromSeconds; ///< what the report is about, from the first datagram on
    std::optional<double> toSeconds;
    Limits limits;
};

/// Where to listen.
struct MonitorPlaces {
    std::vector<net::UdpInput> udp;
    std::vector<net::Endpoint> tcpListen;
    std::vector<net::Endpoint> tcp;
};

/// What was meant, or one line about what is wrong with it. Port 9763 of UDP where nothing is named.
[[nodiscard]] tl::expected<MonitorPlaces, std::string> placesOf(const MonitorOptions& options);

/// Both return when there is nothing more to come, or Ctrl+C was pressed.
ExitStatus monitorNetwork(const MonitorOptions& options, Console& console);
ExitStatus monitorFile(const MonitorOptions& options, Console& console);

} // namespace posewire::cli
