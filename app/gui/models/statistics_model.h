// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/statistics_columns.h"
#include "app/gui/models/stream_tree_model.h"
#include "core/log/time.h"

#include <QList>

#include <deque>
#include <optional>
#include <vector>

namespace posewire::gui {

/// Every figure of every stream, with sums for each character and sender, over the range that is chosen.
/// Without one they keep counting while the display is paused. Figures are made when they are asked for, once
/// per refresh, and curves once per second.
class StatisticsModel : public StreamTreeModel {
    Q_OBJECT

public:
    /// The points of a row's curve, and what it spans where no range is chosen: two minutes.
    static constexpr int kCurvePoints = 120;
    static constexpr log::Duration kCurve = std::chrono::seconds(120);

    explicit StatisticsModel(model::SessionView& view, QObject* parent = nullptr);

    void refresh();

    /// Valid until the next refresh.
    [[nodiscard]] const model::StreamFigures& figures(const QModelIndex& index) const;
    /// The range of the figures; nothing for all.
    [[nodiscard]] const std::optional<model::TimeRange>& range() const { return m_range; }

    /// A line for each stream, with titles (RFC 4180): sender, character, type, and every figure.
    [[nodiscard]] QString csv() const;

    [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
    [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    struct Curve {
        QList<float> rates; ///< NaN where the stream was not there
        QList<float> marks; ///< above 0 where samples were lost
    };
    struct Cached {
        std::uint64_t turn = 0;      ///< of the figures
        std::uint64_t curveTurn = 0; ///< likewise
        model::StreamFigures figures;
        Curve curve;
    };

    [[nodiscard]] Cached& cached(const QModelIndex& index) const;
    [[nodiscard]] model::StreamFigures sumOf(const QModelIndex& index) const;
    [[nodiscard]] const Curve& curve(const QModelIndex& index) const;
    [[nodiscard]] Curve makeCurve(const QModelIndex& index) const;
    void addStreams(const QModelIndex& index, std::vector<const model::Stream*>& streams) const;
    [[nodiscard]] QVariant nameData(const QModelIndex& index, int role) const;
    [[nodiscard]] QVariant curveData(const QModelIndex& index, int role) const;
    [[nodiscard]] QVariant figureData(const QModelIndex& index, int role) const;

    std::optional<model::TimeRange> m_range;
    model::RangeChoice m_choice;
    std::uint64_t m_turn = 1;
    std::uint64_t m_curveTurn = 1;
    std::chrono::sys_seconds m_curveSecond{};
    mutable std::deque<Cached> m_cache; ///< by the node of the row
};

} // namespace posewire::gui
