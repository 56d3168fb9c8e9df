// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/stage/probe.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

namespace posewire::stage {
namespace {

constexpr std::chrono::milliseconds kRest(1);
constexpr std::chrono::milliseconds kBeforeRetry(100);
/// The spool is begun if no server has answered for so long.
constexpr log::Duration kPatience = std::chrono::milliseconds(500);
constexpr log::Duration kAtEnd = std::chrono::seconds(2);

} // namespace

Probe::Probe(log::PacketLog& log, const log::Clock& clock, ProbeChoice choice,
             std::function<std::string()> health)
    : m_log(log),
      m_clock(clock),
      m_choice(std::move(choice)),
      m_health(std::move(health)),
      m_subject("posewire." + m_choice.site + "." + m_choice.name + "."),
      m_reader(log),
      m_senders(log.senders()),
      m_spool(m_choice.spoolFolder, m_choice.spoolMost),
      m_publishing([this](const std::stop_token& stop) { publish(stop); }),
      m_pulsing([this](const std::stop_token& stop) { pulse(stop); }) {}

Probe::~Probe() {
    m_publishing.request_stop();
    m_pulsing.request_stop();
}

ProbeFigures Probe::figures() const {
    const std::lock_guard lock(m_mutex);
    return m_figures;
}

std::shared_ptr<Server> Probe::server() const {
    const std::lock_guard lock(m_mutex);
    return m_server;
}

void Probe::publish(const std::stop_token& stop) {
    while (!stop.stop_requested() && !connect()) {
        std::this_thread::sleep_for(kBeforeRetry);
    }
    const bool isInOrder = server() != nullptr && publishLeft(stop);
    while (isInOrder) {
        const bool isEnding = stop.stop_requested();
        if (!fill(isEnding)) {
            if (isEnding) {
                return;
            }
            std::this_thread::sleep_for(m_rest);
        } else if (!store(m_batch, m_run, stop)) {
            break;
        } else {
            m_next = m_batch.first() + m_batch.count();
            if (const auto last = m_reader.packet(m_next - 1)) {
                m_spool.noteStored(m_log.timeline().wallOf(last->stamp), last->bytes);
            }
            m_reader.refresh();
            if (m_spool.isOpen() && m_reader.end() == m_next) {
                m_spool.drop();
            }
            const std::lock_guard lock(m_mutex);
            m_figures.waiting = m_reader.end() - m_next;
            m_figures.spoolBytes = m_spool.bytes();
        }
    }
    m_reader.refresh();
    if (m_reader.end() != m_next) {
        static_cast<void>(beginSpool());
        m_spool.leave();
    }
}

bool Probe::connect() {
    auto connected = Server::connect(m_choice.servers, "posewire-cli probe " + m_choice.name);
    if (!connected) {
        note(connected.error().text);
        return false;
    }
    const std::lock_guard lock(m_mutex);
    m_server = std::move(*connected);
    m_figures.problem.clear();
    return true;
}

/// Notes what is wrong, and begins the spool if it lasts.
void Probe::note(std::string problem) {
    const log::Moment now = m_clock.monotonic();
    m_failingSince = std::min(m_failingSince, now);
    if (now - m_failingSince >= kPatience) {
        if (const auto why = beginSpool()) {
            problem += "; and nothing is kept on the disk meanwhile: " + why->text;
        }
    }
    m_reader.refresh();
    const std::lock_guard lock(m_mutex);
    m_figures.problem = std::move(problem);
    m_figures.waiting = m_reader.end() - m_next;
    m_figures.spoolBytes = m_spool.bytes();
}

std::optional<log::FileError> Probe::beginSpool() {
    return m_spool.isOpen() ? std::nullopt : m_spool.begin(m_log);
}

/// Publishes, as a run of its own, what the probe before left in the spool. Returns false if the probe is to
/// end and no server answers.
bool Probe::publishLeft(const std::stop_token& stop) {
    const std::string run = newRun();
    Batch batch;
    std::uint64_t number = 0;
    bool isStored = true;
    std::pair<log::WallTime, std::vector<std::byte>> last;
    const auto storeIt = [&] {
        isStored = batch.isEmpty() || store(batch, run, stop);
        if (isStored && !batch.isEmpty()) {
            m_spool.noteStored(last.first, last.second);
        }
        batch.clear();
    };
    m_spool.readLeft([&](const log::FileRecord& record) {
        const log::WallTime time = record.time.value_or(log::WallTime());
        const log::Packet packet{number,       log::asStamp(time) - record.setBy,
                                 {},           record.kernelDropsBefore,
                                 record.flags, record.bytes};
        if (!batch.hasRoomFor(packet)) {
            storeIt();
        }
        if (isStored) {
            batch.add(packet, record.sender.value_or(log::SenderInfo{}));
            last.first = time;
            last.second.assign(record.bytes.begin(), record.bytes.end());
            ++number;
        }
    });
    if (isStored) {
        storeIt();
    }
    if (isStored) {
        m_spool.dropLeft();
    }
    return isStored;
}

bool Probe::fill(bool isEnding) {
    m_batch.clear();
    m_reader.refresh();
    const std::uint64_t end = m_reader.end();
    m_rest = kWait;
    if (end == m_next) {
        return false;
    }
    if (end - m_next < kBatch && !isEnding) {
        const auto first = m_reader.packetFrom(m_next);
        m_rest -= first ? m_log.timeline().now(m_clock) - first->stamp : kWait;
        if (m_rest > log::Duration::zero()) {
            return false;
        }
    }
    for (std::uint64_t number = m_next; number < end; ++number) {
        auto packet = m_reader.packet(number);
        if (!packet && m_batch.isEmpty()) {
            packet = m_reader.packetFrom(number); // memory and spool have dropped those before
            const std::uint64_t gone = (packet ? packet->number : end) - number;
            number += gone;
            const std::lock_guard lock(m_mutex);
            m_figures.gone += gone;
        }
        if (!packet || !m_batch.hasRoomFor(*packet)) {
            m_next = m_batch.isEmpty() ? number : m_next;
            break;
        }
        const log::SenderInfo* const sender = m_senders.find(packet->sender);
        const log::SenderInfo known = sender != nullptr ? *sender : log::SenderInfo{};
        // Readers learn from it that the port was not listened to between two runs.
        packet->flags.afterClosed |= m_heard.insert({known.transport, known.localPort}).second;
        m_batch.add(*packet, known);
    }
    return !m_batch.isEmpty();
}

/// Tries until a server has stored it. Returns false if the probe is to end and no server answers.
bool Probe::store(const Batch& batch, const std::string& run, const std::stop_token& stop) {
    const std::string id = m_choice.name + '-' + run + '-' + std::to_string(batch.first());
    const std::array<Server::Header, 4> headers{{{kLayoutHeader, std::to_string(kLayout)},
                                                 {kRunHeader, run},
                                                 {kFirstHeader, std::to_string(batch.first())},
                                                 {kCountHeader, std::to_string(batch.count())}}};
    log::Moment ends = log::Moment::max();
    while (true) {
        const auto stored = server()->store(m_subject + "batch", batch.bytes(), headers, id);
        if (stored) {
            m_failingSince = log::Moment::max();
            const std::lock_guard lock(m_mutex);
            m_figures.stored += batch.count();
            m_figures.problem.clear();
            m_figures.spoolBytes = m_spool.bytes();
            return true;
        }
        note(stored.error().text);
        const log::Moment now = m_clock.monotonic();
        ends = stop.stop_requested() ? std::min(ends, now + kAtEnd) : ends;
        if (now >= ends) {
            return false;
        }
        std::this_thread::sleep_for(kBeforeRetry);
    }
}

std::string Probe::healthText() const {
    const ProbeFigures figures = this->figures();
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(m_health());
    json["layout"] = kLayout;
    json["run"] = m_run;
    json["timeNs"] = m_log.timeline().now(m_clock).time_since_epoch().count();
    json["stored"] = figures.stored;
    json["waiting"] = figures.waiting;
    json["gone"] = figures.gone;
    json["spoolBytes"] = figures.spoolBytes;
    return json.dump();
}

/// Publishes the health once a second, and answers readers that compare clocks.
void Probe::pulse(const std::stop_token& stop) {
    constexpr log::Duration kPeriod = std::chrono::seconds(1);
    constexpr std::chrono::milliseconds kLook(100);
    Subscription clock;
    Subscription twins;
    log::Moment told{};
    while (!stop.stop_requested()) {
        const auto server = this->server();
        if (server == nullptr) {
            std::this_thread::sleep_for(kLook);
            continue;
        }
        if (!clock) {
            clock = server->listen(m_subject + "clock").value_or(nullptr);
            twins = server->listen(m_subject + "health").value_or(nullptr);
        }
        if (m_clock.monotonic() - told >= kPeriod) {
            told = m_clock.monotonic();
            static_cast<void>(server->publish(m_subject + "health", healthText()));
            const std::string refusal = server->refusal();
            const std::lock_guard lock(m_mutex);
            m_figures.refusal = refusal;
        }
        if (const Message asked = clock ? Server::next(clock, kLook) : nullptr) {
            const auto now = m_log.timeline().now(m_clock).time_since_epoch().count();
            server->reply(asked, std::to_string(now));
        }
        while (const Message heard = twins ? Server::next(twins, kRest) : nullptr) {
            const auto json = nlohmann::json::parse(textOf(heard), nullptr, false);
            if (const auto run = json.find("run"); run != json.end() && run->is_string() && *run != m_run) {
                const std::lock_guard lock(m_mutex);
                m_figures.hasTwin = true;
            }
        }
    }
}

} // namespace posewire::stage
