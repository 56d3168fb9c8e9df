// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/joint_motion.h"

#include "app/gui/base/background.h"
#include "app/gui/models/shown_character.h"

namespace posewire::gui {
namespace {

bool isWindow(const model::RangeChoice& choice) {
    return choice.last > log::Duration::zero() && !choice.fixed && !choice.isSinceReset;
}

} // namespace

bool JointMotion::Request::leadsTo(const Request& next) const {
    return next.key == key && next.isSent == isSent && next.choice == choice && next.range.to >= range.to &&
           (isWindow(choice) ? next.range.from >= range.from : next.range.from == range.from);
}

void JointMotion::follow(const model::SessionView& view, const model::CharacterKey& key, bool isSent) {
    const auto whole = wholeSpan(view);
    if (!whole || (m_work.valid() && !isReady(m_work))) {
        return;
    }
    if (m_work.valid()) {
        Work work = m_work.get();
        m_feed = std::move(work.feed);
        m_extents = work.extents;
        m_isAtEnd = work.isAtEnd;
    }
    const Request request{key, isSent, view.choices().range, view.range().value_or(*whole)};
    const bool goesOn = m_request && m_request->leadsTo(request);
    if (goesOn && m_isAtEnd && m_request->range.to == request.range.to) {
        return;
    }
    const log::Duration window = isWindow(request.choice) ? request.choice.last : log::Duration::zero();
    feed::PoseSource source = feed::poseSourceOf(view, request.range, {&key, 1});
    if (source.characters.empty()) {
        return;
    }
    if (goesOn) {
        m_feed->update(std::move(source));
    } else {
        m_feed = std::make_unique<feed::JointFeed>(std::move(source), isSent, window);
        m_extents = {};
        m_isAtEnd = false;
    }
    m_request = request;
    // Live, a sample waits for its other messages; no more of these come at a moment of the past.
    const bool isLive = view.choices().cursor.mode == model::Cursor::Mode::Following && !view.isRecording() &&
                        !request.choice.fixed;
    const log::Stamp now = isLive ? view.cursorStamp() : request.range.to + 2 * model::kSentTogether;
    m_work = std::async(std::launch::async,
                        [feed = std::move(m_feed), now]() mutable { return read(std::move(feed), now); });
}

JointMotion::Work JointMotion::read(std::unique_ptr<feed::JointFeed> feed, log::Stamp now) {
    constexpr auto kMost = std::chrono::milliseconds(50);
    const auto begin = std::chrono::steady_clock::now();
    Work work;
    while (!work.isAtEnd && std::chrono::steady_clock::now() - begin < kMost) {
        work.isAtEnd = !feed->advance(now);
    }
    work.extents = feed->extents();
    work.feed = std::move(feed);
    return work;
}

} // namespace posewire::gui
