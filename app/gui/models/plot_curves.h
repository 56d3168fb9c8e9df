// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/feed/signal.h"
#include "core/model/session/session_view.h"

#include <QJsonObject>
#include <QString>

#include <atomic>
#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <vector>

namespace posewire::gui {

/// Curves of one batch: added at once, so read in one pass over the log.
struct CurveBatch;

struct PlotCurve {
    /// Its values in the packets of one port of the sender.
    struct Part {
        std::shared_ptr<CurveBatch> batch;
        std::size_t source = 0;
        std::size_t signal = 0; ///< of the source
        log::SenderId sender{};
    };

    feed::Expression expression;
    std::optional<int> character{};           ///< ID; nothing: of the shown one, as soon as there is one
    std::optional<model::CharacterKey> key{}; ///< whose packets are read
    int colour = 0;                           ///< for plotColour()
    std::vector<Part> parts{};

    [[nodiscard]] QString text() const { return QString::fromStdString(expression.text); }
};

/// One value axis with its curves.
struct PlotChart {
    std::vector<PlotCurve> curves;
    bool isLog = false;
    std::optional<std::pair<double, double>>
        range{}; ///< chosen by the operator; nothing: fits what is in view

    /// The unit of all its curves; empty if they differ.
    [[nodiscard]] QString unit() const;
};

/// The least and most of a curve within a pixel, or one of its values if they are far apart.
struct PlotPoint {
    double seconds = 0; ///< since the window's begin
    double least = 0;
    double most = 0;
    bool followsGap = false; ///< samples are missing since the point before
};

struct PlotValue {
    double value = 0;
    feed::SeriesRow row;
};

/// Curves of fields over the session's time. Reads the log on a thread of its own if there is much of it:
/// whoever looks at values waits until that thread has stopped, a few milliseconds, and calls resume() then.
class PlotCurves {
public:
    /// A chart does not take more by itself: its curves have colours of their own.
    static constexpr std::size_t kCurvesOfChart = 8;
    static constexpr std::size_t kMostCurves = 96;

    explicit PlotCurves(model::SessionView& view) : m_view(view) {}
    ~PlotCurves() { pause(); }
    PlotCurves(const PlotCurves&) = delete;
    PlotCurves& operator=(const PlotCurves&) = delete;

    [[nodiscard]] const std::vector<PlotChart>& charts() const { return m_charts; }
    void setRange(std::size_t chart, std::optional<std::pair<double, double>> range);
    void toggleLog(std::size_t chart);
    [[nodiscard]] std::size_t count() const;
    /// In a chart, or in the first with the same unit and room for it, or in a new one. One that the chart
    /// has already is not added again.
    std::optional<filter::FilterError> add(const QString& text, std::optional<std::size_t> chart = {},
                                           std::optional<int> character = {});
    void remove(std::size_t chart, std::size_t curve);
    /// Into a new chart below all others.
    void moveApart(std::size_t chart, std::size_t curve);
    void clear();

    /// Takes in what came. The rest is read in the background if it is much.
    void refresh();
    void resume();
    [[nodiscard]] bool isReading() const { return m_share < 1; }
    /// How much of the log was read, 0 to 1, as of the newest refresh().
    [[nodiscard]] double share() const { return m_share; }
    /// Changes with whatever changes curves; as of the newest refresh() or resume().
    [[nodiscard]] std::uint64_t version() const { return m_changes + m_read; }

    /// One for each pixel, or each value as long as there are at most four in a pixel.
    [[nodiscard]] std::vector<PlotPoint> points(const PlotCurve& curve, const model::TimeRange& window,
                                                std::size_t pixels);
    /// The newest value by then; nothing in gaps, and once it is stale.
    [[nodiscard]] std::optional<PlotValue> valueAt(const PlotCurve& curve, log::Stamp stamp);
    /// All values in a window as a table, a row for each packet; nothing if there are more than `most`.
    [[nodiscard]] std::optional<QByteArray> csv(const model::TimeRange& window, std::size_t most);

    [[nodiscard]] QJsonObject state() const;
    /// Replaces all curves; leaves out what it does not understand. False if nothing is left.
    bool restore(const QJsonObject& state);

private:
    void pause();
    void find(PlotCurve& curve);
    void readNew();
    [[nodiscard]] std::vector<std::uint8_t> typesOf(const PlotCurve& curve, const model::CharacterKey& key);

    model::SessionView& m_view;
    std::vector<PlotChart> m_charts;
    std::vector<std::shared_ptr<CurveBatch>> m_batches;
    std::future<void> m_reading;
    std::atomic<bool> m_isWanted{false}; ///< the thread that reads is to stop
    double m_share = 1;
    std::uint64_t m_read = 0;    ///< packets, of all batches
    std::uint64_t m_changes = 0; ///< by the operator
};

} // namespace posewire::gui
