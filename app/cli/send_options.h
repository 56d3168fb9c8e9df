// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/command.h"
#include "app/cli/send_line.h"
#include "app/net/datagram_sender.h"
#include "core/performer/performer.h"

#include <tl/expected.hpp>

namespace posewire::cli {

/// What `send` was asked for, as typed.
struct SendOptions {
    std::vector<std::string> to{"127.0.0.1:9763"};
    bool overTcp = false;
    std::string types = "all";
    std::string revision = "N";
    double durationSeconds = 0.0; ///< 0: without end
    performer::PerformerSettings performer;

    int senders = 1;
    performer::FaultSettings faults;
    std::string gilbertElliott; ///< p,r or p,r,k,h; empty: none
    std::string restart;        ///< S or S:SAMPLE
    std::string pause;          ///< S:S
    std::string reduction;      ///< S:K
    std::string truth;          ///< file to write what was sent to; empty: none

    std::string file; ///< empty: the performer
    double speed = 1.0;
    bool loops = false;
};

/// The rest is what was meant by it, or one line about what is wrong with it.
using Complaint = std::string;
[[nodiscard]] tl::expected<std::vector<net::SendTarget>, Complaint> targetsOf(const SendOptions& options);
[[nodiscard]] tl::expected<performer::PerformerSettings, Complaint> performerOf(const SendOptions& options);

[[nodiscard]] tl::expected<performer::FaultSettings, Complaint> faultsOf(const SendOptions& options);

/// Sends until the recording is through or `durationSeconds` have passed.
ExitStatus sendFile(const SendOptions& options, std::vector<SendLine>& lines, Console& console);

} // namespace posewire::cli
