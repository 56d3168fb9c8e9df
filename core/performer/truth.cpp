// SPDX-License-Identifier: MIT
#include "core/performer/truth.h"

#include "core/wire/type_table.h"

#include <algorithm>
#include <cstdlib>

namespace posewire::performer {
namespace {

/// Parts of a message that is sent again and again come within this time.
constexpr log::Duration kTogether = std::chrono::milliseconds(250);

} // namespace

bool StreamTruth::Parts::isComplete() const {
    const auto upToLast = arrived << (arrived.size() - 1 - static_cast<std::size_t>(std::max(last, 0)));
    return last >= 0 && std::cmp_equal(upToLast.count(), last + 1);
}

bool StreamTruth::Parts::add(const wire::Header& header) {
    const std::uint8_t index = header.datagramIndex();
    if (arrived.test(index)) {
        return false;
    }
    arrived.set(index);
    if (header.isLast()) {
        last = index;
    }
    return true;
}

std::int64_t StreamTruth::Run::place(std::uint32_t sample) const {
    return last + distance(sample, static_cast<std::uint32_t>(last));
}

StreamTruth::Parts& StreamTruth::Run::at(std::int64_t position) {
    for (; position < base; --base) {
        samples.emplace_front();
    }
    const auto place = static_cast<std::size_t>(position - base);
    if (place >= samples.size()) {
        samples.resize(place + 1);
    }
    return samples[place];
}

void StreamTruth::add(const wire::Header& header, const Sending& sending) {
    ++m_figures.datagrams;
    if (!wire::isSampled(header.type())) {
        addMessage(header, sending);
    } else if (Run* run = runOf(header, sending.origin)) {
        addTo(*run, header, sending.due);
    }
}

/// What a receiver takes for one message: indices that do not repeat, close together. The same bytes again
/// are a duplicate, unless they are a whole message.
void StreamTruth::addMessage(const wire::Header& header, const Sending& sending) {
    const log::Duration time = sending.due;
    const bool isWhole = header.datagramIndex() == 0 && header.isLast();
    const bool isRepeat = !isWhole && std::ranges::any_of(m_messageParts, [&](const auto& part) {
        return time - part.first <= kTogether && part.second == sending.bytes;
    });
    if (isRepeat) {
        ++m_figures.duplicates;
        return;
    }
    const bool isOpen = m_message.isTouched();
    if (!isOpen || time - m_messageAt > kTogether || !m_message.add(header)) {
        m_figures.incomplete += isOpen && !m_message.isComplete() ? 1 : 0;
        m_message = {};
        m_messageParts.clear();
        m_messageAt = time;
        m_message.add(header);
    }
    m_messageParts.emplace_back(time, sending.bytes);
}

StreamTruth::Run* StreamTruth::runOf(const wire::Header& header, const Origin& origin) {
    const std::uint32_t sample = header.sampleCounter;
    const bool isIntact = sample == origin.sample;
    if (!isIntact && std::abs(distance(sample, origin.sample)) > kMostForward) {
        return nullptr;
    }
    bool isKnown = false;
    for (auto newest = m_runs.rbegin(); newest != m_runs.rend(); ++newest) {
        Run& run = *newest;
        if (run.epoch != origin.epoch || run.regime != origin.regime) {
            continue;
        }
        isKnown = true;
        const std::int64_t place = run.place(sample);
        if (place >= run.first - kMostBack && place <= run.last + kMostForward) {
            return &run;
        }
    }
    const std::int64_t moved =
        m_runs.empty() ? 0 : distance(sample, static_cast<std::uint32_t>(m_runs.back().last));
    const bool isRestart = moved < -kMostBack || moved > kMostForward;
    if (isRestart && (!isKnown || moved > 0)) {
        ++m_figures.restarts;
        return &beginRun(header, origin);
    }
    if (isKnown) {
        return nullptr;
    }
    if (!m_runs.empty() && m_runs.back().regime == origin.regime) {
        // So short a way back is a repetition of samples, not a restart.
        m_runs.back().epoch = origin.epoch;
        return &m_runs.back();
    }
    return &beginRun(header, origin);
}

StreamTruth::Run& StreamTruth::beginRun(const wire::Header& header, const Origin& origin) {
    const std::int64_t first = header.sampleCounter;
    m_runs.push_back({origin.epoch, origin.regime, origin.step, m_figures.restarts, first, first, first});
    return m_runs.back();
}

void StreamTruth::addTo(Run& run, const wire::Header& header, log::Duration time) {
    const std::int64_t place = run.place(header.sampleCounter);
    if (!run.at(place).add(header)) {
        // A restart forgets the counters of before.
        m_figures.duplicates += run.restarts == m_figures.restarts ? 1 : 0;
        return;
    }
    run.first = std::min(run.first, place);
    if (run.advances.empty() || place > run.last) {
        run.last = place;
        run.advances.emplace_back(place, time);
        return;
    }
    if (place == run.last) {
        return;
    }
    ++m_figures.reordered;
    const auto overtaking = std::ranges::partition_point(
        run.advances, [&](const auto& advance) { return advance.first <= place; });
    m_figures.late += time - overtaking->second > kLate ? 1 : 0;
}

SentFigures StreamTruth::figures() const {
    SentFigures figures = m_figures;
    figures.incomplete += m_message.isTouched() && !m_message.isComplete() ? 1 : 0;
    for (const Run& run : m_runs) {
        std::uint64_t touched = 0;
        for (const Parts& parts : run.samples) {
            touched += parts.isTouched() ? 1 : 0;
            figures.samples += parts.isComplete() ? 1 : 0;
            figures.incomplete += parts.isTouched() && !parts.isComplete() ? 1 : 0;
        }
        const auto expected = static_cast<std::uint64_t>((run.last - run.first) / run.step + 1);
        figures.lost += expected - touched;
        figures.step = touched > 1 ? run.step : 0;
    }
    if (!m_runs.empty()) {
        figures.firstSample = static_cast<std::uint32_t>(m_runs.front().first);
        figures.lastSample = static_cast<std::uint32_t>(m_runs.back().last);
    }
    return figures;
}

void Truth::add(const Sending& sending) {
    if (!wire::startsWithMagic(sending.bytes)) {
        ++m_sender.foreign;
        return;
    }
    m_sender.bytes += sending.bytes.size();
    if (!wire::decodeInto(sending.bytes, m_scratch)) {
        ++m_sender.malformed;
        return;
    }
    ++m_sender.datagrams;
    const wire::Header header = sending.origin.header.value_or(m_scratch.header);
    m_streams[{header.character, header.type()}].add(header, sending);
}

void StreamedTruth::add(const Sending& sending) {
    m_size += sending.bytes.size();
    m_sent.push_back({m_size, sending.due, sending.origin});
    m_framer.push(sending.bytes, [this](const log::TcpFramer::Piece& piece) { take(piece); });
}

void StreamedTruth::finish() {
    m_framer.finish([this](const log::TcpFramer::Piece& piece) { take(piece); });
}

void StreamedTruth::take(const log::TcpFramer::Piece& piece) {
    while (m_sent.size() > 1 && m_sent.front().end <= piece.offset) {
        m_sent.pop_front();
    }
    if (piece.kind == log::TcpFramer::Kind::Datagram) {
        m_truth.add({{piece.bytes.begin(), piece.bytes.end()}, m_sent.front().due, m_sent.front().origin});
    }
}

} // namespace posewire::performer
