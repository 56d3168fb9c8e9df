// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/command.h"
#include "app/net/datagram_sender.h"
#include "app/stage/range.h"
#include "core/log/time.h"
#include "core/performer/faults.h"
#include "core/performer/performer.h"
#include "core/performer/truth.h"

#include <tl/expected.hpp>

#include <optional>
#include <string>
#include <vector>

namespace posewire::cli {

/// One sender with its network faults, a socket for each target, and a record of what went through each.
class SendLine {
public:
    struct Sender {
        std::string address;
        std::string target; ///< as asked for
        bool isTcp = false;
        net::DatagramSender sender;
        performer::Truth datagrams;        ///< used by UDP
        performer::StreamedTruth streamed; ///< used by TCP
        bool isRefusalTold = false;

        [[nodiscard]] const performer::Truth& truth() const { return isTcp ? streamed.truth() : datagrams; }
    };

    static net::NetResult<SendLine> open(const std::vector<net::SendTarget>& targets,
                                         const performer::FaultSettings& faults, bool keepsTruth);

    [[nodiscard]] performer::Faults& faults() { return m_faults; }
    [[nodiscard]] const performer::Faults& faults() const { return m_faults; }
    /// To all targets.
    net::NetResult<void> send(const performer::Sending& sending);
    net::NetResult<void> finish();

    [[nodiscard]] const std::vector<Sender>& senders() const { return m_senders; }
    /// Says of each target once that the network has refused something: there may be no end to it.
    void tellRefusals(const Console& console);

private:
    SendLine(const performer::FaultSettings& faults, bool keepsTruth)
        : m_faults(faults), m_keepsTruth(keepsTruth) {}

    performer::Faults m_faults;
    std::vector<Sender> m_senders;
    bool m_keepsTruth;
};

/// Sends what the lines have due, on time.
class SendRound {
public:
    SendRound(std::vector<SendLine>& lines, net::SendSchedule& schedule)
        : m_lines(lines), m_schedule(schedule) {}

    /// All that is due before this time after the start; without one the rest. The error is why a connection
    /// ended.
    net::NetResult<void> send(std::optional<log::Duration> until);

private:
    struct Leaving {
        std::size_t line = 0;
        performer::Sending sending;
    };

    std::vector<SendLine>& m_lines;
    net::SendSchedule& m_schedule;
    std::vector<performer::Sending> m_taken;
    std::vector<Leaving> m_leaving;
};

struct SendOptions {
    std::vector<std::string> to{"127.0.0.1:9763"};
    bool overTcp = false;
    std::string types = "all";
    std::string revision = "N";
    std::string forms = "real";
    std::string up = "z";
    double durationSeconds = 0.0; ///< 0: without end
    performer::PerformerSettings performer;

    int senders = 1;
    performer::FaultSettings faults;
    std::string gilbertElliott; ///< p,r or p,r,k,h; empty: none
    std::string restart;        ///< S or S:SAMPLE
    std::string pause;          ///< S:S
    std::string reduction;      ///< S:K
    performer::ContentBreakSettings fault;
    std::string truth;     ///< file to write what was sent to; empty: none
    bool replaces = false; ///< that file, where it exists

    std::string file; ///< empty: the performer
    double speed = 1.0;
    bool loops = false;
    stage::Range range;
    bool isVerbose = false; ///< tells from where to where
};

/// The rest is what was meant by it, or one line about what is wrong with it.
using Complaint = std::string;
[[nodiscard]] tl::expected<std::vector<net::SendTarget>, Complaint> targetsOf(const SendOptions& options);
[[nodiscard]] tl::expected<performer::PerformerSettings, Complaint> performerOf(const SendOptions& options);

[[nodiscard]] tl::expected<performer::FaultSettings, Complaint> faultsOf(const SendOptions& options);

/// What was really sent, as JSON with the names of the report of `monitor`. Fails with one line for the user.
tl::expected<void, std::string> writeTruth(const SendOptions& options, const std::vector<SendLine>& lines);

/// Sends until the recording is through or `durationSeconds` have passed.
ExitStatus sendFile(const SendOptions& options, std::vector<SendLine>& lines, Console& console);

} // namespace posewire::cli
