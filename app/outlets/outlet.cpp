// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/outlets/outlet.h"

#include "app/outlets/follow.h"
#ifndef _WIN32
#include "app/outlets/osc.h"
#include "app/outlets/ros.h"
#endif

#include <algorithm>
#include <utility>

namespace posewire::outlets {
namespace {

using Started = net::NetResult<std::unique_ptr<Outlet>>;

/// Datagrams as they came; needs no poses.
class RelayedDatagrams final : public Outlet {
public:
    static Started start(const OutletChoice& choice, const OutletPlace& place) {
        const auto target = net::parseTarget(choice.place);
        if (!target) {
            return tl::unexpected(target.error());
        }
        const auto relay = place.relay ? place.relay : std::make_shared<net::Relay>(place.log, place.clock);
        auto added = relay->add(*target, place.inputs);
        if (!added) {
            return tl::unexpected(std::move(added.error()));
        }
        return std::make_unique<RelayedDatagrams>(relay, *added);
    }

    RelayedDatagrams(std::shared_ptr<net::Relay> relay, net::RelayId id)
        : m_relay(std::move(relay)), m_id(id) {}
    ~RelayedDatagrams() override { m_relay->remove(m_id); }
    RelayedDatagrams(const RelayedDatagrams&) = delete;
    RelayedDatagrams& operator=(const RelayedDatagrams&) = delete;

    void update(const model::SessionView& /*session*/) override {}
    [[nodiscard]] OutletState state() const override {
        const std::vector<net::RelayTarget> targets = m_relay->targets();
        const net::RelayTarget& own = *std::ranges::find(targets, m_id, &net::RelayTarget::id);
        return {.place = net::textOf(own.endpoint),
                .receivers = 1,
                .sent = own.sent,
                .refused = own.refused,
                .skipped = own.skipped,
                .behind = own.behind,
                .problem = own.problem,
                .returner = own.isStopped ? std::optional(own.returner) : std::nullopt};
    }
    [[nodiscard]] std::optional<net::NetError>
    problemWith(const std::vector<net::InputStatus>& inputs) const override {
        return m_relay->problemWith(m_id, inputs);
    }

private:
    std::shared_ptr<net::Relay> m_relay;
    net::RelayId m_id;
};

template <auto makeWriter>
Started startPoses(const OutletChoice& choice, const OutletPlace& place) {
    return PoseOutlet::start(place.log, place.clock, makeWriter(choice));
}

constexpr OutletKind kKinds[] = {
    {"datagrams", "Datagrams", "", false, false, true, "datagram", "what is received, unchanged, by UDP",
     RelayedDatagrams::start},
    {"follow", "JSON lines", "-", true, false, false, "line", "poses as lines of JSON, to all who connect",
     startPoses<followAt>},
#ifndef _WIN32
    {"osc", "OSC", "127.0.0.1:9000", true, false, true, "datagram", "poses as Open Sound Control, by UDP",
     startPoses<oscTo>},
    {"vmc", "VMC", "127.0.0.1:39539", true, true, true, "datagram",
     "poses of one character by the VMC protocol, by UDP", startPoses<vmcTo>},
    {"ros2", "ROS 2", "0", true, false, false, "message",
     "poses as /tf and /joint_states of ROS 2, in a domain of DDS", startPoses<rosIn>},
#endif
};

} // namespace

std::span<const OutletKind> outletKinds() {
    return kKinds;
}

const OutletKind* findOutletKind(std::string_view name) {
    const auto found = std::ranges::find(kKinds, name, &OutletKind::name);
    return found == std::end(kKinds) ? nullptr : &*found;
}

} // namespace posewire::outlets
