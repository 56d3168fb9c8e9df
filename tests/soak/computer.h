// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/sender_table.h"
#include "tests/core/performer/receiving.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace posewire::soak {

using namespace std::chrono_literals;

/// A time in which all computers send, and what goes wrong in it.
struct Act {
    double rateHz = 2;
    std::uint64_t frames = 0;
    bool isCalm = false;
    bool restartsCounter = false;
    log::Duration clockStep{}; ///< somebody sets this computer's clock in the middle of it
    int summerTime = 0;        ///< hours by which the time code jumps in the middle of it

    [[nodiscard]] log::Duration at(std::uint64_t frame) const {
        return log::durationOf(static_cast<double>(frame) / rateHz);
    }
};

/// All kinds of faults, in other shares with every seed.
inline performer::FaultSettings faultsOf(const Act& act, std::uint64_t seed) {
    performer::FaultSettings faults;
    faults.seed = seed;
    faults.rateHz = act.rateHz;
    if (act.isCalm) {
        return faults;
    }
    const performer::KeyedRandom random(seed);
    const double seconds = static_cast<double>(act.frames) / act.rateHz;
    faults.drop = random.uniform(1, 0.0, 0.02);
    faults.burst = 1 + static_cast<int>(random.bits(2) % 20);
    faults.duplicate = random.uniform(3, 0.0, 0.01);
    faults.reorder = random.uniform(4, 0.0, 0.01);
    faults.corrupt = random.uniform(5, 0.0, 0.001);
    faults.truncate = random.uniform(6, 0.0, 0.001);
    faults.jitterMs = seed % 4 == 1 ? random.uniform(8, 0.0, 20.0) : 0.0;
    faults.splits = seed % 2 == 0;
    faults.pause = performer::FaultSettings::Pause{seconds / 4, seconds / 80};
    if (seed % 3 == 0) {
        faults.reduction = performer::FaultSettings::Reduction{seconds / 2, 2};
    }
    return faults;
}

/// A computer that sends two characters, six streams that count samples, with what it knows of all that left
/// it.
class Computer {
public:
    static constexpr int kCharacters = 2;
    static constexpr std::array<std::uint8_t, 5> kTypes{2, 12, 13, 24, 25};
    using Sums = std::map<performer::Truth::StreamKey, performer::SentFigures>;

    /// `first`: the ID of its first character.
    Computer(std::string host, int first)
        : m_host(std::move(host)), m_first(first), m_seed(static_cast<std::uint64_t>(first / kCharacters)) {}

    /// The sending program is started, with a port of its own.
    void start(log::SenderTable& senders, int port) {
        m_sender = senders.intern({m_host + ':' + std::to_string(port), log::Transport::Udp, 9763});
        m_sums.clear();
        m_total = {};
        m_firstSample = 0U - 2000U; // and soon past the greatest
        m_frames = 0;
    }

    void begin(const Act& act) {
        m_act = act;
        m_seed += 2;
        performer::FaultSettings faults = faultsOf(act, m_seed);
        m_isRestarted = m_frames != 0 && (act.restartsCounter || m_hasReduced);
        m_firstSample = m_isRestarted ? 1 : m_firstSample + m_frames;
        m_frames = static_cast<std::uint32_t>(act.frames);
        m_hasReduced = faults.reduction.has_value();
        faults.restart = {0.0, m_firstSample}; // no faults there
        m_faults.emplace(faults);
        m_truth = {};
    }

    /// A frame of the act, with all characters. Appends what leaves before it; finish() appends the rest.
    void send(std::uint64_t frame, std::vector<wire::Datagram>& datagrams,
              std::vector<performer::Sending>& into) {
        for (wire::Datagram& datagram : datagrams) {
            datagram.header.sampleCounter = m_firstSample + static_cast<std::uint32_t>(frame);
            if (isOwn(datagram.header.character) && wire::encodeInto(datagram, m_bytes)) {
                m_faults->offer(m_bytes, m_act.at(frame));
            }
        }
        m_faults->take(m_act.at(frame), into);
    }
    void finish(std::vector<performer::Sending>& into) { m_faults->take(std::nullopt, into); }

    void noteLeft(const performer::Sending& sending) { m_truth.add(sending); }

    /// Everything of the act has left.
    void end() {
        for (const auto& [key, stream] : m_truth.streams()) {
            if (isOwn(key.character) && std::ranges::count(kTypes, key.type) != 0) {
                addTo(m_sums[key], stream.figures(), wire::isSampled(key.type));
            }
        }
        const performer::SenderFigures& sender = m_truth.sender();
        m_total.datagrams += sender.datagrams;
        m_total.malformed += sender.malformed;
        m_total.foreign += sender.foreign;
        m_truth = {};
    }

    [[nodiscard]] log::SenderId sender() const { return m_sender; }
    /// Since it was started, without step and counters.
    [[nodiscard]] const Sums& sums() const { return m_sums; }
    [[nodiscard]] const performer::SenderFigures& total() const { return m_total; }

private:
    [[nodiscard]] bool isOwn(int character) const {
        return character >= m_first && character < m_first + kCharacters;
    }
    void addTo(performer::SentFigures& sum, const performer::SentFigures& act, bool isSampled) const {
        const bool isContinued = isSampled && sum.datagrams != 0 && !m_isRestarted;
        sum.datagrams += act.datagrams;
        sum.samples += act.samples;
        sum.lost += act.lost + (isContinued ? act.firstSample - sum.lastSample - 1 : 0);
        sum.duplicates += act.duplicates;
        sum.reordered += act.reordered;
        sum.late += act.late;
        sum.incomplete += act.incomplete;
        sum.restarts += act.restarts + (isSampled && m_isRestarted ? 1 : 0);
        sum.lastSample = act.lastSample;
    }

    std::string m_host;
    int m_first;
    std::uint64_t m_seed;
    log::SenderId m_sender{};
    Act m_act;
    std::uint32_t m_firstSample = 0;
    std::uint32_t m_frames = 0; ///< of the act before
    bool m_isRestarted = false;
    bool m_hasReduced = false;
    std::optional<performer::Faults> m_faults;
    std::vector<std::byte> m_bytes;
    performer::Truth m_truth; ///< of the act
    Sums m_sums;
    performer::SenderFigures m_total;
};

} // namespace posewire::soak
