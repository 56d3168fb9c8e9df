// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/shown_character.h"
#include "app/gui/theme/character_mark.h"
#include "core/model/accounting/stream_figures.h"
#include "core/model/session/losses.h"
#include "core/model/session/session_view.h"

#include <QString>

#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace posewire::gui {

/// The rows of the timeline: characters and, where they are opened, their streams, each with what came in the
/// parts of a window of time.
class TimelineModel {
public:
    struct Row {
        model::CharacterKey character;
        std::optional<std::uint8_t> type; ///< of a stream; nothing for all of the character
        QString name;
        CharacterMark mark;
        std::vector<log::StreamKey> streams; ///< under all ports that the sender had
        bool isOpen = false;
        std::vector<model::RangePart> parts; ///< empty until shown() asked for it
    };

    /// Datagrams that are looked at one by one; where a window has more, the accounting's buckets have to do.
    static constexpr std::size_t kMostArrivals = 400'000;

    explicit TimelineModel(model::SessionView& view) : m_view(view) {}

    [[nodiscard]] std::optional<model::TimeRange> span() const { return wholeSpan(m_view); }

    /// Reads the rows again, and nothing of the parts yet. At most `most` parts.
    void refresh(const model::TimeRange& window, std::size_t most);
    [[nodiscard]] const std::vector<Row>& rows() const { return m_rows; }
    /// One row with its parts.
    [[nodiscard]] const Row& shown(std::size_t row);
    [[nodiscard]] const model::RangeParts& parts() const { return m_parts; }

    /// Shows or hides the streams of a character.
    void toggle(const model::CharacterKey& key);

    [[nodiscard]] static std::size_t spacingOf(const std::vector<model::RangePart>& parts);
    /// From one part to before another: where nothing came for longer than that, between what came.
    using Gap = std::pair<std::size_t, std::size_t>;
    [[nodiscard]] static std::vector<Gap> gapsIn(const std::vector<model::RangePart>& parts);

private:
    [[nodiscard]] std::uint64_t datagramsIn(const model::TimeRange& window) const;
    void addRows(const model::CharacterKey& key);

    model::SessionView& m_view;
    model::RangeParts m_parts;
    std::optional<model::Losses> m_losses; ///< as of the newest refresh
    std::optional<model::SettledLosses> m_settled;
    bool m_isFine = false; ///< parts are finer than the accounting's buckets
    std::vector<Row> m_rows;
    std::set<model::CharacterKey> m_open;
};

} // namespace posewire::gui
