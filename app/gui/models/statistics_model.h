// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/stream_tree_model.h"
#include "core/log/time.h"
#include "core/model/accounting/stream_figures.h"
#include "core/model/session/losses.h"

#include <QList>

#include <deque>
#include <optional>
#include <vector>

namespace posewire::gui {

/// The columns of the statistics: the name of a row, then figures, and among them the curve of the rate.
inline constexpr int kStatisticsColumns = 36;
inline constexpr int kNameColumn = 0;
inline constexpr int kCurveColumn = 10;

/// The figure of a column; nothing for the name and the curve.
[[nodiscard]] std::optional<model::Figure> figureIn(int column);

/// Every figure of every stream, with sums for each character and sender, over the range that is chosen.
/// Without one they keep counting while the display is paused. Figures are made when they are asked for, once
/// per refresh, and curves once per second.
class StatisticsModel : public StreamTreeModel {
public:
    /// The points of a row's curve, and what it spans where no range is chosen: two minutes.
    static constexpr int kCurvePoints = 120;
    static constexpr log::Duration kCurve = std::chrono::seconds(120);

    explicit StatisticsModel(model::SessionView& view);

    void refresh();

    /// Valid until the next refresh.
    [[nodiscard]] const model::StreamFigures& figures(const QModelIndex& index) const;
    /// The range of the figures; nothing for all.
    [[nodiscard]] const std::optional<model::TimeRange>& range() const { return m_range; }

    /// Those of a row and below it, in the order of the rows.
    [[nodiscard]] std::vector<const model::Stream*> streamsOf(const QModelIndex& index) const {
        std::vector<const model::Stream*> streams;
        addStreams(index, streams);
        return streams;
    }

    /// A line for each stream, with titles (RFC 4180): sender, character, type, and every figure.
    [[nodiscard]] QString csv() const;

private:
    struct Curve {
        QList<float> rates; ///< NaN where the stream was not there
        QList<float> marks; ///< above 0 where samples were lost
    };
    struct Cached {
        std::optional<model::StreamFigures> figures;
        std::optional<Curve> curve;
    };

    [[nodiscard]] Cached& cached(const QModelIndex& index) const;
    [[nodiscard]] model::StreamFigures sumOf(const QModelIndex& index) const;
    [[nodiscard]] const Curve& curve(const QModelIndex& index) const;
    [[nodiscard]] Curve makeCurve(const QModelIndex& index) const;
    /// Those of a row and below it, in the order of the rows.
    void addStreams(const QModelIndex& index, std::vector<const model::Stream*>& streams) const;
    [[nodiscard]] std::string csvLine(const model::Stream& stream) const;

    /// Read the model only where a cell is asked for.
    [[nodiscard]] static std::vector<TableColumn<StreamRow>> columns(const StatisticsModel& model);
    [[nodiscard]] static TableColumn<StreamRow> figureColumn(const StatisticsModel& model,
                                                             model::Figure figure);
    [[nodiscard]] static TableColumn<StreamRow> curveColumn(const StatisticsModel& model);

    std::optional<model::TimeRange> m_range;
    std::optional<model::Losses> m_losses; ///< in the range, as of the newest refresh; never empty
    model::RangeChoice m_choice;
    std::chrono::time_point<log::LogTime, std::chrono::seconds> m_curveSecond{};
    mutable std::deque<Cached> m_cache; ///< by the node of the row; what is in it stays where it is
};

/// Datagrams and losses of all streams over the whole history, in parts of equal length; read again once a
/// second.
class RangeOverview {
public:
    static constexpr std::size_t kMostParts = 240;

    explicit RangeOverview(model::SessionView& view) : m_view(view) {}

    void refresh();

    /// All there is, whatever the cursor.
    [[nodiscard]] const model::TimeRange& span() const { return m_span; }
    [[nodiscard]] const model::RangeParts& parts() const { return m_parts; }
    [[nodiscard]] const std::vector<model::RangePart>& counted() const { return m_counted; }
    [[nodiscard]] bool empty() const { return m_parts.count == 0; }
    /// The coarsest of the streams: finer ranges make no difference.
    [[nodiscard]] log::Duration resolution() const { return m_resolution; }

private:
    model::SessionView& m_view;
    model::TimeRange m_span;
    model::RangeParts m_parts;
    std::vector<model::RangePart> m_counted;
    log::Duration m_resolution{1};
};

} // namespace posewire::gui
