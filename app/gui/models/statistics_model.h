// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/property_model.h"
#include "core/model/session.h"

#include <QAbstractTableModel>
#include <QList>

#include <optional>
#include <vector>

namespace posewire::gui {

/// One row for each stream in the order of first appearance: rates, spacing and counts as they are now (they
/// go on while the display is paused), and the rate of the last two minutes as a small curve.
class StatisticsModel : public QAbstractTableModel {
    Q_OBJECT

public:
    enum Column : int {
        kStream,
        kRate,
        kTrend,
        kLost,
        kDeviation,
        kLeast,
        kMean,
        kMost,
        kBandwidth,
        kDatagrams,
        kMalformed,
        kColumnCount
    };
    static constexpr int kTrendSeconds = 120;

    explicit StatisticsModel(model::SessionView& view, QObject* parent = nullptr);

    void refresh();
    [[nodiscard]] const model::Stream& stream(int row) const;

    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
    [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    /// Rates of the last two minutes, one a second; NaN for seconds in which nobody looked.
    struct Trend {
        QList<float> rates;
        std::uint64_t datagrams = 0; ///< at the last second
    };
    void addTrend();
    [[nodiscard]] QString text(const model::Stream& stream, int column) const;
    [[nodiscard]] Health health(const model::Stream& stream, int column) const;

    model::SessionView& m_view;
    int m_rows = 0;
    std::vector<Trend> m_trends;
    std::optional<std::int64_t> m_trendSecond;
};

/// What this computer and program do: memory, packets kept, datagrams dropped here.
[[nodiscard]] std::vector<Property> receiverFacts(model::SessionView& view);

} // namespace posewire::gui
