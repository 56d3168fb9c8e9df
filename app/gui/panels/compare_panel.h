// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/comparison.h"
#include "app/gui/base/panel.h"
#include "app/gui/base/playback.h"
#include "app/gui/driver/comparing.h"
#include "app/gui/models/difference_model.h"
#include "app/gui/panels/compare_bar.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/plots/time_plot.h"
#include "app/gui/theme/widgets.h"

#include <QSplitter>
#include <QWidget>
#include <Qt>

namespace posewire::gui {

/// Dock `compare`: how far the poses of what is shown are from those of a second recording, segment by
/// segment, at the moment that is shown and over the range, with how they went.
class ComparePanel : public Panel {
    Q_OBJECT

public:
    ComparePanel(model::SessionView& view, Commands& commands, Playback& playback, Comparing& comparing,
                 QWidget* parent);

    [[nodiscard]] static std::span<const ActionInfo> actionTable();
    void refresh() override;
    [[nodiscard]] QString summary() const override;
    [[nodiscard]] QJsonObject state() const override;
    void restoreState(const QJsonObject& state) override;

    // What the actions do; nothing while nothing is compared but what is asked for then.
    using By = std::optional<exporting::AlignBy>;
    void alignBy(By by);
    [[nodiscard]] By alignedBy() const { return choice().by; }
    /// By samples of the second recording.
    void nudge(int samples);
    void clearOffset();
    void setFrame(model::DifferenceFrame frame);
    [[nodiscard]] model::DifferenceFrame frame() const { return choice().frame; }
    void toggleBeside();
    [[nodiscard]] bool isBeside() const { return choice().isBeside; }
    void workAgain() { m_comparing.workAgain(); }
    void stopWork() { m_comparing.stop(); }
    void save();

private:
    [[nodiscard]] const ComparisonState& comparison() const { return m_comparing.state(); }
    [[nodiscard]] const ComparisonChoice& choice() const { return comparison().choice; }
    template <class Change>
    void change(Change change);
    void layOut();
    void connectParts();
    void showEmpty(const QString& text, bool isOpen);
    void showFigures();
    void plot();
    void followSelection();
    void select(const QModelIndex& index);

    Playback& m_playback;
    Comparing& m_comparing;
    DifferenceModel m_differences;
    QWidget* m_empty = new QWidget(this);
    QLabel* m_emptyText = dimText({}, m_empty);
    QToolButton* m_begin;
    QWidget* m_content = new QWidget(this);
    CompareBar* m_bar = new CompareBar(m_content);
    ElidedLabel* m_figures = new ElidedLabel(Qt::AlignLeft | Qt::AlignVCenter, m_content);
    ElidedLabel* m_counts = new ElidedLabel(Qt::AlignLeft | Qt::AlignVCenter, m_content);
    DifferenceLegend* m_legend = new DifferenceLegend(m_content);
    QToolButton* m_stop = framedButton({}, {}, m_content);
    QSplitter* m_splitter = new QSplitter(Qt::Vertical, m_content);
    TableView* m_table = new TableView(tr("Differences by segment"), m_content);
    TimePlot* m_plot;
    std::shared_ptr<const exporting::MotionComparison> m_plotted;
    int m_plottedSlot = -2;
    bool m_isFollowing = false;
};

} // namespace posewire::gui
