// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/feed/joint_feed.h"

#include <future>
#include <memory>
#include <optional>

namespace posewire::gui {

/// Range of motion of a character's joints over the range that all figures are of. Packets are read on a
/// thread, for a short time after each call.
class JointMotion {
public:
    /// Takes what was read and has more read. `isSent`: of type 20 rather than of poses.
    void follow(const model::SessionView& view, const model::CharacterKey& key, bool isSent);

    [[nodiscard]] const model::JointExtents& extents() const { return m_extents; }
    /// Not all of the range had been read when the extents were taken.
    [[nodiscard]] bool isReading() const { return !m_isAtEnd; }
    /// All that there was at the last call has been read and taken.
    [[nodiscard]] bool isAtRest() const { return m_isAtEnd && !m_work.valid(); }

private:
    struct Request {
        model::CharacterKey key;
        bool isSent = false;
        model::RangeChoice choice;
        model::TimeRange range;

        /// A feed of this request can go on with `next`.
        [[nodiscard]] bool leadsTo(const Request& next) const;
    };
    struct Work {
        std::unique_ptr<feed::JointFeed> feed;
        model::JointExtents extents;
        bool isAtEnd = false;
    };
    static Work read(std::unique_ptr<feed::JointFeed> feed, log::Stamp now);

    std::optional<Request> m_request;        ///< of the feed
    std::unique_ptr<feed::JointFeed> m_feed; ///< null while it reads
    model::JointExtents m_extents;
    bool m_isAtEnd = false;
    std::future<Work> m_work;
};

} // namespace posewire::gui
