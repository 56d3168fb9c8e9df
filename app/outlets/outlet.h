// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/relay.h"
#include "core/log/clock.h"
#include "core/log/packet_log.h"
#include "core/model/session/session_view.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Ways out: what is received, in forms that other programs read.
namespace posewire::outlets {

struct OutletState {
    std::string place;         ///< where others find it, or where it sends to
    std::size_t receivers = 0; ///< now
    std::uint64_t poses = 0;   ///< handed to the writer
    std::uint64_t sent = 0;    ///< lines or datagrams, of all receivers
    std::uint64_t refused = 0; ///< by this system, or because no program listens there
    std::uint64_t skipped = 0; ///< left out for receivers that did not read in time, or for fear of a loop
    std::uint64_t behind = 0;  ///< packets that wait to be handed on
    std::uint64_t missed = 0;  ///< packets that the log had dropped before the outlet read them
    std::string problem;       ///< why the newest was refused, or why nothing is sent; empty if all is well
    std::optional<log::SenderId> returner{}; ///< who sent datagrams back, so that it was stopped
};

/// Hands on what is received in one form, on a thread of its own: receiving never waits for it.
class Outlet {
public:
    virtual ~Outlet() = default;
    /// Poses are of the characters as this session knows them, up to where it has followed the log. From the
    /// thread that has it follow, again and again.
    virtual void update(const model::SessionView& session) = 0;
    [[nodiscard]] virtual OutletState state() const = 0;
    /// Why it cannot stay with these inputs; nothing if it can.
    [[nodiscard]] virtual std::optional<net::NetError>
    problemWith(const std::vector<net::InputStatus>& /*inputs*/) const {
        return {};
    }
};

struct OutletChoice {
    std::string place;
    std::string character; ///< a name or ID, of those that take one; empty: the first that is listed
};

/// The surroundings of an outlet. Log and clock must outlive it.
struct OutletPlace {
    const log::PacketLog& log;
    const log::Clock& clock;
    std::vector<net::InputStatus> inputs; ///< no datagrams are sent back into these
    std::shared_ptr<net::Relay> relay;    ///< of all outlets of datagrams, which know of one another
};

/// A row for each form.
struct OutletKind {
    std::string_view name; ///< on the command line, and where choices are kept
    const char* title;
    std::string_view place; ///< where it goes if none is chosen; empty: one has to be
    bool hasPoses;
    bool isOfOne;          ///< character
    bool needsHost;        ///< else a number alone is a place
    std::string_view unit; ///< what is sent: "line"
    const char* help;
    net::NetResult<std::unique_ptr<Outlet>> (*start)(const OutletChoice& choice, const OutletPlace& place);
};
[[nodiscard]] std::span<const OutletKind> outletKinds();
/// Null if there is no such kind.
[[nodiscard]] const OutletKind* findOutletKind(std::string_view name);

} // namespace posewire::outlets
