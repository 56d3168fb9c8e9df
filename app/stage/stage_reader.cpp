// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/stage/stage_reader.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>

namespace posewire::stage {
namespace {

constexpr std::chrono::milliseconds kLook(50);
constexpr std::chrono::milliseconds kBeforeSubscribing(200);

/// The probe's own time.
log::Stamp stampOf(const log::FileRecord& record) {
    return log::asStamp(record.time.value_or(log::WallTime())) - record.setBy;
}

template <class Value>
Value valueOf(const nlohmann::json& json, const char* name, Value otherwise) {
    const auto found = json.find(name);
    try {
        return found == json.end() ? otherwise : found->get<Value>();
    } catch (const nlohmann::json::exception&) {
        return otherwise;
    }
}

} // namespace

StageReader::StageReader(net::Receiver& receiver, const log::PacketLog& log, const log::Clock& clock,
                         StageChoice choice)
    : m_receiver(receiver),
      m_log(log),
      m_clock(clock),
      m_choice(std::move(choice)),
      m_reading([this](const std::stop_token& stop) { read(stop); }),
      m_pulsing([this](const std::stop_token& stop) { pulse(stop); }) {}

StageReader::~StageReader() {
    m_reading.request_stop();
    m_pulsing.request_stop();
}

std::vector<ProbeState> StageReader::probes() const {
    const log::Stamp now = m_log.timeline().now(m_clock);
    const std::lock_guard lock(m_mutex);
    std::vector<ProbeState> probes;
    for (const auto& [name, state] : m_probes) {
        ProbeState& probe = probes.emplace_back(state);
        probe.isAlive = now - probe.lastHeard < kDeadAfter;
        probe.rateHz = probe.isAlive ? probe.rateHz : 0;
    }
    return probes;
}

std::vector<std::string> StageReader::takeSilent() {
    std::vector<std::string> silent;
    for (const ProbeState& probe : probes()) {
        const std::lock_guard lock(m_mutex);
        if (probe.isAlive) {
            m_silent.erase(probe.name);
        } else if (m_silent.insert(probe.name).second) {
            silent.push_back(probe.name);
        }
    }
    return silent;
}

std::string StageReader::problem() const {
    const std::lock_guard lock(m_mutex);
    return m_problem.empty() && m_server != nullptr ? m_server->refusal() : m_problem;
}

std::shared_ptr<Server> StageReader::server() const {
    const std::lock_guard lock(m_mutex);
    return m_server;
}

void StageReader::setProblem(std::string text) {
    const std::lock_guard lock(m_mutex);
    m_problem = std::move(text);
}

/// Subscribes again, from the next message on, after three seconds of silence: the servers may have chosen
/// another leader and forgotten us.
void StageReader::read(const std::stop_token& stop) {
    constexpr log::Duration kSilence = std::chrono::seconds(3);
    log::Moment heard{};
    while (!stop.stop_requested()) {
        if (m_batches == nullptr || m_clock.monotonic() - heard > kSilence) {
            heard = m_clock.monotonic();
            if (!subscribe()) {
                std::this_thread::sleep_for(kBeforeSubscribing);
                continue;
            }
        }
        if (const Message batch = Server::next(m_batches, kLook)) {
            heard = m_clock.monotonic();
            take(batch);
        }
    }
}

bool StageReader::subscribe() {
    auto server = this->server();
    if (server == nullptr) {
        auto connected = Server::connect(m_choice.servers, "posewire");
        if (!connected) {
            setProblem(connected.error().text);
            return false;
        }
        server = std::move(*connected);
        const std::lock_guard lock(m_mutex);
        m_server = server;
    }
    const auto stream = server->stream(m_choice.site);
    if (!stream) {
        setProblem(stream.error().text);
        return false;
    }
    if (m_nextInStream == 0 && !m_choice.since) {
        m_nextInStream = stream->last + 1;
    }
    auto batches = server->read(m_choice.site, "posewire." + m_choice.site + ".*.batch", m_nextInStream,
                                m_choice.since.value_or(log::WallTime()));
    if (!batches) {
        setProblem(batches.error().text);
        return false;
    }
    m_batches = std::move(*batches);
    setProblem({});
    return true;
}

void StageReader::take(const Message& batch) {
    m_nextInStream = std::max(m_nextInStream, sequenceOf(batch) + 1);
    std::uint64_t bytes = 0;
    const BatchOrder::Taken taken = m_order.take(batch, [&](const log::FileRecord& record) {
        bytes += record.bytes.size();
        m_receiver.submit(record.bytes, *record.sender, log::arrivalOf(record, {}, stampOf(record)));
    });
    if (taken.probe.empty()) {
        return;
    }
    const std::lock_guard lock(m_mutex);
    ProbeState& probe = m_probes[taken.probe];
    probe.name = taken.probe;
    probe.received += taken.packets;
    probe.receivedBytes += bytes;
    probe.lostOnWay += taken.lostOnWay;
    probe.problem = taken.problem.empty() ? probe.problem : taken.problem;
}

void StageReader::pulse(const std::stop_token& stop) {
    constexpr log::Duration kPeriod = std::chrono::seconds(2);
    Subscription health;
    log::Moment compared{};
    while (!stop.stop_requested()) {
        const auto server = this->server();
        if (server != nullptr && health == nullptr) {
            health = server->listen("posewire." + m_choice.site + ".*.health").value_or(nullptr);
        }
        if (health == nullptr) {
            std::this_thread::sleep_for(kLook);
        } else if (const Message heard = Server::next(health, kLook)) {
            takeHealth(heard);
        }
        if (server != nullptr && m_clock.monotonic() - compared >= kPeriod) {
            compared = m_clock.monotonic();
            compareClocks(*server);
        }
    }
}

void StageReader::takeHealth(const Message& health) {
    const std::string name = probeOf(health);
    const auto json = nlohmann::json::parse(textOf(health), nullptr, false);
    if (!json.is_object() || name.empty()) {
        return;
    }
    const log::Stamp now = m_log.timeline().now(m_clock);
    const auto stored = valueOf(json, "stored", std::uint64_t{0});
    const std::lock_guard lock(m_mutex);
    ProbeState& probe = m_probes[name];
    const double seconds = log::secondsOf(now - probe.lastHeard);
    const bool isFollowing = probe.name == name && stored >= probe.stored && seconds > 0;
    probe.rateHz = isFollowing ? static_cast<double>(stored - probe.stored) / seconds : 0;
    probe.stored = stored;
    probe.name = name;
    probe.lastHeard = now;
    probe.version = valueOf(json, "version", std::string());
    probe.host = valueOf(json, "host", std::string());
    probe.kernelDropped = valueOf(json, "kernelDropped", std::uint64_t{0});
    probe.spoolBytes = valueOf(json, "spoolBytes", std::uint64_t{0});
}

/// Keeps the exchange of least delay, which is off by least. Its delay counts for more with time, since
/// clocks drift.
void StageReader::compareClocks(Server& server) {
    constexpr std::chrono::milliseconds kWait(300);
    constexpr double kForget = 1.2; // a period
    for (const ProbeState& probe : probes()) {
        if (!probe.isAlive) {
            continue;
        }
        const log::Stamp asked = m_log.timeline().now(m_clock);
        const auto answer =
            server.request("posewire." + m_choice.site + "." + probe.name + ".clock", "", kWait);
        const log::Stamp answered = m_log.timeline().now(m_clock);
        if (!answer) {
            continue;
        }
        const auto there = numberOf(textOf(*answer));
        const std::lock_guard lock(m_mutex);
        ProbeState& known = m_probes[probe.name];
        known.uncertainty = log::durationOf(log::secondsOf(known.uncertainty) * kForget);
        if (const log::Duration half = (answered - asked) / 2;
            there && (!known.ahead || half <= known.uncertainty)) {
            known.ahead = log::stampOf(static_cast<std::int64_t>(*there)) - (asked + half);
            known.uncertainty = half;
        }
    }
}

} // namespace posewire::stage
