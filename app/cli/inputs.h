// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/command.h"
#include "app/net/receiver.h"

#include <QCoreApplication>

#include <array>
#include <string>
#include <vector>

namespace posewire::cli {

/// The inputs, as they were typed.
struct InputOptions {
    std::vector<std::string> udp;
    std::vector<std::string> multicast;
    std::vector<std::string> tcpListen;
    std::vector<std::string> tcp;
    std::vector<std::string> allowed; ///< hosts and nets to listen to; none: all
};

/// Adds the options that say where to receive from.
std::array<DeclaredOption, 5> addPlaces(Arguments arguments, InputOptions& options);

struct Places {
    std::vector<net::UdpInput> udp;
    std::vector<net::Endpoint> tcpListen;
    std::vector<net::Endpoint> tcp;
};

/// Port 9763 of UDP if none is named. The error is one line for the user.
[[nodiscard]] tl::expected<Places, std::string> placesOf(const InputOptions& options);

/// `--duration`, of a command that goes on until it is interrupted.
void addDuration(Arguments arguments, double& seconds);

/// The application that Qt's sockets want to exist. One at a time.
class SocketApplication {
    std::string m_name = "posewire-cli";
    std::array<char*, 2> m_arguments{m_name.data(), nullptr};
    int m_count = 1;
    QCoreApplication m_application{m_count, m_arguments.data()};
};

/// As messages have it: "port 9763", or an address with a port.
[[nodiscard]] std::string placeOf(const net::InputStatus& input);

/// False, with a complaint, if one cannot be opened. Names the ports that the system chose.
[[nodiscard]] bool openInputs(const Places& places, const InputOptions& options, bool isVerbose,
                              net::Receiver& receiver, Console& console);

} // namespace posewire::cli
