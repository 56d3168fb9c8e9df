// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/compare_panel.h"

#include "app/gui/base/saving.h"
#include "app/gui/models/comparison_text.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/theme/event_watch.h"

#include <QItemSelectionModel>

#include <algorithm>
#include <cmath>

namespace posewire::gui {

namespace {

using CompareDo = ActionsOf<ComparePanel>;
using exporting::AlignBy;
using model::DifferenceFrame;
using By = ComparePanel::By;

constexpr const char* kFile = "&File";
constexpr const char* kCompare = QT_TRANSLATE_NOOP("Action", "&Time/&Comparison");

template <int choice>
constexpr By kBy = choice < 0 ? By() : By(static_cast<AlignBy>(choice));

template <int choice>
void alignBy(ComparePanel& panel) {
    panel.alignBy(kBy<choice>);
}
template <int choice>
bool isAlignedBy(const ComparePanel& panel) {
    return panel.alignedBy() == kBy<choice>;
}

template <int choice>
constexpr ActionInfo alignment(const char* id, const char* text) {
    return {id, kCompare, text, "", CompareDo::call<alignBy<choice>>, CompareDo::is<isAlignedBy<choice>>};
}

template <DifferenceFrame frame>
constexpr ActionInfo overlay(const char* id, const char* text) {
    constexpr auto set = CompareDo::call<&ComparePanel::setFrame, frame>;
    return {id, kCompare, text, "", set, CompareDo::is<&ComparePanel::frame, frame>};
}

constexpr ActionInfo kCompareActions[] = {
    {"saveDifferences", kFile, QT_TRANSLATE_NOOP("Action", "Save di&fferences…"), "",
     CompareDo::call<&ComparePanel::save>},
    alignment<-1>("alignAutomatically", QT_TRANSLATE_NOOP("Action", "Align auto&matically")),
    alignment<0>("alignByTimeCode", QT_TRANSLATE_NOOP("Action", "Align by &time code")),
    alignment<1>("alignBySample", QT_TRANSLATE_NOOP("Action", "Align by &sample counter")),
    alignment<2>("alignByBegin", QT_TRANSLATE_NOOP("Action", "Align the &beginnings")),
    lineIn(kCompare),
    {"nudgeEarlier", kCompare, QT_TRANSLATE_NOOP("Action", "Second one a sample &earlier"), "[",
     CompareDo::call<&ComparePanel::nudge, -1>},
    {"nudgeLater", kCompare, QT_TRANSLATE_NOOP("Action", "Second one a sample &later"), "]",
     CompareDo::call<&ComparePanel::nudge, 1>},
    {"nudgeNone", kCompare, QT_TRANSLATE_NOOP("Action", "Wit&hout offset"), "",
     CompareDo::call<&ComparePanel::clearOffset>},
    lineIn(kCompare),
    overlay<DifferenceFrame::World>("compareAsSent", QT_TRANSLATE_NOOP("Action", "Compare &as sent")),
    overlay<DifferenceFrame::Heading>("compareOnTheSpot",
                                      QT_TRANSLATE_NOOP("Action", "Compare &on the spot")),
    overlay<DifferenceFrame::Pelvis>("compareWithoutPelvis",
                                     QT_TRANSLATE_NOOP("Action", "Compare without the &pelvis")),
    {"compareBeside", kCompare, QT_TRANSLATE_NOOP("Action", "&Draw it beside"), "",
     CompareDo::call<&ComparePanel::toggleBeside>, CompareDo::is<&ComparePanel::isBeside>},
    lineIn(kCompare),
    {"compareAgain", kCompare, QT_TRANSLATE_NOOP("Action", "&Work out the range again"), "",
     CompareDo::call<&ComparePanel::workAgain>},
    {"compareStop", kCompare, QT_TRANSLATE_NOOP("Action", "Stop wor&king it out"), "",
     CompareDo::call<&ComparePanel::stopWork>},
};

using exporting::DifferenceCourse;

TimePlot* makePlot(QWidget* parent) {
    auto* plot = new TimePlot(ComparePanel::tr("Differences over time"), 1, parent);
    for (const double least : {1.0, 0.5}) { // mm, degrees
        const int chart = plot->addChart({}, 1, least);
        plot->addCurve(chart, &Theme::dim);
        plot->addCurve(chart, &Theme::accent);
    }
    return plot;
}

std::vector<TimePlot::Point> pointsOf(const std::vector<float>& parts, double length) {
    std::vector<TimePlot::Point> points;
    points.reserve(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        points.push_back({(static_cast<double>(i) + 0.5) * length, static_cast<double>(parts[i])});
    }
    return points;
}

std::vector<TimePlot::Gap> gapsOf(const std::vector<float>& parts, double length) {
    std::vector<TimePlot::Gap> gaps;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const double from = static_cast<double>(i) * length;
        if (!std::isnan(parts[i])) {
            continue;
        }
        if (!gaps.empty() && gaps.back().second >= from - length / 2) {
            gaps.back().second = from + length;
        } else {
            gaps.emplace_back(from, from + length);
        }
    }
    return gaps;
}

} // namespace

std::span<const ActionInfo> ComparePanel::actionTable() {
    return kCompareActions;
}

void ComparePanel::save() {
    const auto& range = comparison().range;
    if (range == nullptr || range->segments.empty()) {
        m_comparing.save({}); // says why not
        return;
    }
    const QString path = askWhereToSave(this, tr("Save differences"), QStringLiteral("differences.csv"),
                                        tr("Comma-separated values (*.csv)"));
    if (!path.isEmpty()) {
        m_comparing.save(path);
    }
}

ComparePanel::ComparePanel(model::SessionView& view, Commands& commands, Playback& playback,
                           Comparing& comparing, QWidget* parent)
    : Panel(view, commands, parent),
      m_playback(playback),
      m_comparing(comparing),
      m_begin(framedButton(tr("Compare with a recording…"), tr("Open a second recording (Ctrl+Shift+O)"),
                           m_empty)),
      m_plot(makePlot(m_content)) {
    setBackgroundRole(QPalette::Base);
    setAutoFillBackground(true);
    m_table->setModel(&m_differences);
    m_table->sortByColumn(DifferenceModel::kMean, Qt::DescendingOrder);
    m_table->setSortingEnabled(true);
    layOut();
    connectParts();
    new EventWatch(this, QEvent::Resize, [this] {
        m_splitter->setOrientation(width() > height() * 3 / 2 ? Qt::Horizontal : Qt::Vertical);
    });
    refresh();
}

void ComparePanel::layOut() {
    const int margin = CellDelegate::margin(fontMetrics());
    auto* column = tightColumn(this);
    column->addWidget(m_empty);
    column->addWidget(m_content);
    auto* empty = new QVBoxLayout(m_empty);
    empty->addStretch();
    m_emptyText->setAlignment(Qt::AlignHCenter);
    empty->addWidget(m_emptyText);
    empty->addWidget(m_begin, 0, Qt::AlignHCenter);
    empty->addStretch();
    auto* content = tightColumn(m_content);
    auto* head = new QVBoxLayout;
    head->setContentsMargins(margin, margin, margin, margin / 2);
    head->setSpacing(margin / 2);
    head->addWidget(m_bar);
    head->addWidget(m_figures);
    auto* counts = spacedRow({}, margin);
    counts->addWidget(m_counts, 1);
    counts->addWidget(m_legend);
    counts->addWidget(m_stop);
    head->addLayout(counts);
    content->addLayout(head);
    content->addWidget(new Line(m_content));
    content->addWidget(m_splitter, 1);
    m_splitter->addWidget(m_table);
    m_splitter->addWidget(m_plot);
    m_splitter->setStretchFactor(0, 3);
    m_splitter->setStretchFactor(1, 2);
    m_splitter->setHandleWidth(1);
    for (ElidedLabel* label : {m_figures, m_counts}) {
        label->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
    }
    m_figures->setObjectName(QStringLiteral("figures"));
    m_counts->setObjectName(QStringLiteral("counts"));
    m_emptyText->setObjectName(QStringLiteral("emptyText"));
}

void ComparePanel::connectParts() {
    connect(m_begin, &QToolButton::clicked, &m_comparing, &Comparing::askForRecording);
    connect(m_stop, &QToolButton::clicked, this,
            [this] { comparison().isStopped ? workAgain() : stopWork(); });
    connect(m_bar, &CompareBar::partnerChosen, this, [this](const model::CharacterKey& second) {
        if (const auto pair = comparison().pair) {
            change([&](ComparisonChoice& choice) { choice.pair.emplace(pair->first, second); });
        }
    });
    connect(m_bar, &CompareBar::alignmentChosen, this, &ComparePanel::alignBy);
    connect(m_bar, &CompareBar::offsetChosen, this, [this](double offset) {
        change([offset](ComparisonChoice& choice) { choice.offset = offset; });
    });
    connect(m_bar, &CompareBar::nudged, this, &ComparePanel::nudge);
    connect(m_bar, &CompareBar::frameChosen, this, &ComparePanel::setFrame);
    connect(m_bar, &CompareBar::besideToggled, this, &ComparePanel::toggleBeside);
    connect(m_table->selectionModel(), &QItemSelectionModel::currentRowChanged, this, &ComparePanel::select);
    connect(m_plot, &TimePlot::momentPicked, this, [this](double time) {
        if (m_plotted != nullptr) {
            m_playback.showMoment(m_plotted->course.begin + log::durationOf(time));
        }
    });
}

template <class Change>
void ComparePanel::change(Change change) {
    ComparisonChoice chosen = choice();
    change(chosen);
    m_comparing.choose(chosen);
    refresh();
}

void ComparePanel::clearOffset() {
    change([](ComparisonChoice& choice) { choice.offset = 0; });
}

void ComparePanel::toggleBeside() {
    change([](ComparisonChoice& choice) { choice.isBeside = !choice.isBeside; });
}

/// An offset is in the unit of what it was chosen with.
void ComparePanel::alignBy(By by) {
    change([&](ComparisonChoice& choice) {
        choice.by = by;
        choice.offset = 0;
    });
}

void ComparePanel::nudge(int samples) {
    if (const auto alignment = comparison().alignment) {
        change([&](ComparisonChoice& choice) {
            choice.by = alignment->by; // by hand from now on
            choice.offset = alignment->offset + samples * comparison().step;
        });
    }
}

void ComparePanel::setFrame(model::DifferenceFrame frame) {
    change([frame](ComparisonChoice& choice) { choice.frame = frame; });
}

void ComparePanel::refresh() {
    const ComparisonState& state = comparison();
    if (!state.isOpen) {
        showEmpty(tr("Open a second recording, and it is shown over this one at the same moment,\nwith the "
                     "difference of every segment in mm and degrees."),
                  false);
        return;
    }
    const bool isReading = state.second == nullptr || (state.isWorking && state.range == nullptr);
    if (!state.problem.isEmpty()) {
        showEmpty(state.problem, state.second != nullptr);
    } else if (isReading && !state.atCursor) {
        showEmpty(tr("%1 is read: %2 %").arg(state.name).arg(std::floor(100 * state.share)), false);
    } else {
        m_empty->hide();
        m_content->show();
        m_splitter->show();
    }
    m_begin->setVisible(!state.isWorking);
    m_bar->refresh(state);
    m_isFollowing = true;
    m_differences.refresh(state);
    followSelection();
    m_isFollowing = false;
    showFigures();
    plot();
}

/// With the bar, where something else can be chosen there.
void ComparePanel::showEmpty(const QString& text, bool isOpen) {
    m_emptyText->setText(text);
    m_empty->setAccessibleDescription(text);
    m_begin->setText(isOpen ? tr("Another recording…") : tr("Compare with a recording…"));
    m_begin->setVisible(true);
    m_empty->show();
    m_content->setVisible(isOpen);
    m_splitter->setVisible(!isOpen);
}

void ComparePanel::showFigures() {
    const ComparisonState& state = comparison();
    QString text;
    QString more;
    if (state.range != nullptr && state.range->worst() != nullptr) {
        const auto& all = state.range->all.millimetres;
        text = tr("Mean %1 mm, %2 °").arg(fixed(all.mean, 1), fixed(state.range->all.degrees.mean, 2));
        more = tr(" · most in %1 · worst %2 mm at %3 · 95 % below %4 · median %5")
                   .arg(segmentOfSlot(state.range->worst()->slot), fixed(all.most, 1),
                        timeOfDay(m_view.wallOf(all.mostAt)), fixed(all.p95, 1), fixed(all.median, 1));
    }
    m_figures->setText(text, more);
    m_legend->setScale(scaleOf(state));
    m_counts->setText({}, comparedText(state).join(QStringLiteral(" · ")));
    for (ElidedLabel* label : {m_figures, m_counts}) {
        label->setToolTip(toolTipText(label->text()));
        label->setAccessibleName(label->text());
    }
    m_stop->setVisible(state.isWorking || state.isStopped);
    m_stop->setText(state.isStopped ? tr("Work out again")
                                    : tr("Stop (%1 %)").arg(std::floor(100 * state.share)));
    m_stop->setToolTip(
        toolTipText(state.isStopped ? tr("Work out the range") : tr("Give up working out the range")));
}

void ComparePanel::plot() {
    const ComparisonState& state = comparison();
    if (state.range == nullptr || state.range->pairs == 0) {
        return;
    }
    const DifferenceCourse& course = state.range->course;
    const double length = log::secondsOf(course.length);
    const int row = m_table->currentIndex().row();
    const int slot = row < 0 ? -1 : m_differences.rows()[static_cast<std::size_t>(row)].slot;
    if (m_plotted != state.range || m_plottedSlot != slot) {
        m_plotted = state.range;
        m_plottedSlot = slot;
        const auto& mean = course.millimetres[DifferenceCourse::kMean];
        const auto ofSlot = [slot](const auto& all) {
            return slot < 0 ? std::vector<float>() : all[static_cast<std::size_t>(slot)];
        };
        m_plot->setSpan(0, std::max(static_cast<double>(mean.size()) * length, 0.1));
        m_plot->setCurve(0, pointsOf(mean, length));
        m_plot->setCurve(1, pointsOf(ofSlot(course.millimetres), length));
        m_plot->setCurve(2, pointsOf(course.degrees[DifferenceCourse::kMean], length));
        m_plot->setCurve(3, pointsOf(ofSlot(course.degrees), length));
        m_plot->setGaps(gapsOf(mean, length));
        const QString name =
            slot < 0 ? tr("Mean of all") : tr("%1, over the mean of all").arg(segmentOfSlot(slot));
        m_plot->setTitle(0, tr("%1, mm").arg(name));
        m_plot->setTitle(1, tr("%1, degrees").arg(name));
    }
    m_plot->setCursor(log::secondsOf(m_view.cursorStamp() - course.begin));
    m_plot->replot();
}

void ComparePanel::followSelection() {
    const int segment = m_view.choices().selection.segment;
    if (segment < 0 || !comparison().atCursor) {
        return;
    }
    const auto& segments = comparison().atCursor->segments;
    const auto found = std::ranges::find(segments, segment, &model::SegmentDifference::first);
    const int row = found != segments.end() ? m_differences.rowOf(found->slot) : -1;
    if (row >= 0 && row != m_table->currentIndex().row()) {
        m_table->setCurrentIndex(m_differences.index(row, 0));
    }
}

void ComparePanel::select(const QModelIndex& index) {
    if (m_isFollowing || !index.isValid() || !comparison().pair) {
        return;
    }
    const auto& now = m_differences.rows()[static_cast<std::size_t>(index.row())].now;
    if (now) {
        m_commands.select(selectionOf(m_view, comparison().pair->first, now->first));
    }
    plot();
}

QString ComparePanel::summary() const {
    const ComparisonState& state = comparison();
    return state.isOpen && state.atCursor
               ? tr("shown: %1 mm").arg(fixed(state.atCursor->meanMillimetres(), 1))
               : QString();
}

QJsonObject ComparePanel::state() const {
    QJsonObject state = m_table->columns().state();
    state[QStringLiteral("frame")] = static_cast<int>(choice().frame);
    state[QStringLiteral("beside")] = choice().isBeside;
    return state;
}

void ComparePanel::restoreState(const QJsonObject& state) {
    m_table->columns().restore(state);
    const int frame = state["frame"].toInt(0);
    const bool isKnown = frame >= 0 && frame <= static_cast<int>(model::DifferenceFrame::Pelvis);
    change([&](ComparisonChoice& choice) {
        choice.frame = isKnown ? static_cast<model::DifferenceFrame>(frame) : choice.frame;
        choice.isBeside = state["beside"].toBool(choice.isBeside);
    });
}

} // namespace posewire::gui
