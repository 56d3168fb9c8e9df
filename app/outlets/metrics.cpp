// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/outlets/metrics.h"

#include "app/net/listening.h"
#include "app/outlets/metric_families.h"
#include "core/model/session/session_view.h"

#include <prometheus/collectable.h>
#include <prometheus/exposer.h>

#include <chrono>
#include <exception>
#include <future>
#include <mutex>
#include <utility>
#include <vector>

namespace posewire::outlets {
namespace {

/// The families that were made last, for any thread.
class NewestFamilies final : public prometheus::Collectable {
public:
    void set(std::vector<prometheus::MetricFamily> families) {
        auto made = std::make_shared<const std::vector<prometheus::MetricFamily>>(std::move(families));
        const std::lock_guard lock(m_mutex);
        m_families.swap(made);
    }

    [[nodiscard]] std::vector<prometheus::MetricFamily> Collect() const override {
        std::shared_ptr<const std::vector<prometheus::MetricFamily>> families;
        {
            const std::lock_guard lock(m_mutex);
            families = m_families;
        }
        return families != nullptr ? *families : std::vector<prometheus::MetricFamily>();
    }

private:
    mutable std::mutex m_mutex; ///< guards what follows, for the time of a swap
    std::shared_ptr<const std::vector<prometheus::MetricFamily>> m_families;
};

} // namespace

struct Metrics::Parts {
    Parts(const std::string& place, std::string itsVersion) : version(std::move(itsVersion)), exposer(place) {
        exposer.RegisterCollectable(families);
    }

    std::string version;
    std::shared_ptr<NewestFamilies> families = std::make_shared<NewestFamilies>();
    prometheus::Exposer exposer;
};

Metrics::Metrics(std::unique_ptr<Parts> parts, std::string place)
    : m_parts(std::move(parts)), m_place(std::move(place)) {}

/// Wakes the library, which by itself looks only every 2 s whether it is to end.
Metrics::~Metrics() {
    auto ended = std::async(std::launch::async, [this] { m_parts.reset(); });
    while (ended.wait_for(std::chrono::milliseconds(10)) != std::future_status::ready) {
        net::knock(m_place);
    }
}

net::NetResult<std::unique_ptr<Metrics>> Metrics::serve(const std::string& place, std::string version) {
    const auto found = net::freeTcpPlace(place); // the library does not say why it cannot listen
    if (!found) {
        return tl::unexpected(found.error());
    }
    try {
        return std::unique_ptr<Metrics>(
            new Metrics(std::make_unique<Parts>(*found, std::move(version)), *found));
    } catch (const std::exception&) {
        return net::netError(net::NetError::Kind::Other,
                             "cannot serve metrics at " + *found + "; choose another port or address");
    }
}

void Metrics::update(const model::SessionView& session, const OwnFigures& own) {
    m_updated = session.now();
    m_parts->families->set(metricFamilies(session, own, m_parts->version));
}

} // namespace posewire::outlets
