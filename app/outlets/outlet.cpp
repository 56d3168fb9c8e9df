// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/outlets/outlet.h"

#include "app/net/relay.h"
#include "app/outlets/follow.h"
#ifndef _WIN32
#include "app/outlets/osc.h"
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
        auto outlet = std::make_unique<RelayedDatagrams>(place);
        if (auto added = outlet->m_relay.add(*target, place.inputs); !added) {
            return tl::unexpected(std::move(added.error()));
        }
        return outlet;
    }

    explicit RelayedDatagrams(const OutletPlace& place) : m_relay(place.log, place.clock) {}

    void update(const model::SessionView& /*session*/) override {}
    [[nodiscard]] OutletState state() const override {
        const net::RelayTarget target = m_relay.targets().front();
        return {.place = net::textOf(target.endpoint),
                .receivers = 1,
                .sent = target.sent,
                .skipped = target.refused + target.skipped,
                .problem = target.problem};
    }

private:
    net::Relay m_relay;
};

template <auto makeWriter>
Started startPoses(const OutletChoice& choice, const OutletPlace& place) {
    return PoseOutlet::start(place.log, place.clock, makeWriter(choice));
}

constexpr OutletKind kKinds[] = {
    {"datagrams", "", "datagram", "what is received, unchanged, by UDP", RelayedDatagrams::start},
    {"follow", "-", "line", "poses as lines of JSON, to all who connect", startPoses<followAt>},
#ifndef _WIN32
    {"osc", "127.0.0.1:9000", "datagram", "poses as Open Sound Control, by UDP", startPoses<oscTo>},
    {"vmc", "127.0.0.1:39539", "datagram", "poses of one character by the VMC protocol, by UDP",
     startPoses<vmcTo>},
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
