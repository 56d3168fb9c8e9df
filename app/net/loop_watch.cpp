// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/loop_watch.h"

#include <algorithm>
#include <utility>

namespace posewire::net {
namespace {

/// Datagrams in each share of a trial.
constexpr std::uint64_t kShare = 8;
/// After the last one was dealt out, how long they have to come back.
constexpr log::Duration kWayBack = std::chrono::milliseconds(500);
/// Too few new datagrams by then: the trial ends without a result.
constexpr log::Duration kLongestTrial = std::chrono::seconds(10);
/// A stream that arrives twice is left alone for this long.
constexpr log::Duration kTrust = std::chrono::minutes(1);
/// Where streams arrive twice, more returns than this for each new datagram are a loop all the same.
constexpr std::uint64_t kTrustedReturns = 4;
/// Datagrams that must be back before a share counts as back, and how many times as many of it as of
/// nobody's.
constexpr std::uint64_t kFewestBack = 2;
constexpr std::uint64_t kTimesNobodys = 4;

} // namespace

LoopWatch::Route LoopWatch::route(std::uint64_t content, log::SenderId sender, log::Moment now,
                                  std::size_t targets) {
    countSecond(now);
    Slot& slot = m_slots[content % kSlots];
    const bool isKnown = slot.content == content && now - slot.sent < kMemory && slot.sent != log::Moment();
    if (isKnown && slot.sender != sender) {
        m_returner = sender;
        return routeOfReturn(slot, now, targets);
    }
    if (isKnown) { // its sender sends it again
        if (m_trial && slot.trial == m_trialNumber) {
            return routeOfShare(content);
        }
        slot.sent = now;
        return {};
    }
    slot = {content, now, sender};
    ++m_new;
    return m_trial && !m_trial->dealtOut ? deal(slot, now) : Route{};
}

LoopWatch::Route LoopWatch::routeOfReturn(Slot& slot, log::Moment now, std::size_t targets) {
    ++m_returns;
    if (m_trial) {
        if (slot.trial == m_trialNumber && !slot.isBack) {
            slot.isBack = true;
            ++m_trial->shares[shareOf(slot.content)].back;
        }
        return {true, true};
    }
    if (m_returns > mostReturns(now) && targets != 0) {
        ++m_trialNumber;
        m_trial = Trial{std::vector<Share>(targets + 1), now};
        return {true, true};
    }
    slot.sent = now;
    return {true, false};
}

LoopWatch::Route LoopWatch::deal(Slot& slot, log::Moment now) {
    slot.trial = m_trialNumber;
    ++m_trial->shares[shareOf(slot.content)].dealt;
    if (std::ranges::all_of(m_trial->shares, [](const Share& share) { return share.dealt >= kShare; })) {
        m_trial->dealtOut = now;
    }
    return routeOfShare(slot.content);
}

/// By content alone, so that several monitors in a loop that try at once deal out alike.
std::size_t LoopWatch::shareOf(std::uint64_t content) const {
    return static_cast<std::size_t>((content >> 24) % m_trial->shares.size());
}

LoopWatch::Route LoopWatch::routeOfShare(std::uint64_t content) const {
    const std::size_t share = shareOf(content);
    return {false, true, share == 0 ? std::nullopt : std::optional(share - 1)};
}

std::vector<std::size_t> LoopWatch::takeLoops(log::Moment now) {
    if (!m_trial) {
        return {};
    }
    const bool isOver = m_trial->dealtOut && now - *m_trial->dealtOut >= kWayBack;
    if (!isOver && now - m_trial->begun < kLongestTrial) {
        return {};
    }
    const Trial trial = *std::exchange(m_trial, std::nullopt);
    const std::uint64_t nobodys = trial.shares.front().back;
    std::vector<std::size_t> loops;
    for (std::size_t i = 1; i < trial.shares.size(); ++i) {
        const std::uint64_t back = trial.shares[i].back;
        if (back >= kFewestBack && back > kTimesNobodys * nobodys) {
            loops.push_back(i - 1);
        }
    }
    if (loops.empty() && nobodys != 0) {
        m_trusted = now + kTrust;
    }
    return loops;
}

std::uint64_t LoopWatch::mostReturns(log::Moment now) const {
    return now < m_trusted ? kSuspicious + kTrustedReturns * m_new : std::max(kSuspicious, m_new / 2);
}

void LoopWatch::countSecond(log::Moment now) {
    if (now - m_second >= std::chrono::seconds(1)) {
        m_second = now;
        m_new = m_returns = 0;
    }
}

} // namespace posewire::net
