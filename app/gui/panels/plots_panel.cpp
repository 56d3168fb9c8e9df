// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/plots_panel.h"

#include "app/gui/base/saving.h"
#include "app/gui/models/curve_text.h"
#include "app/gui/models/display_filter.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/cell_delegate.h"

#include <QAction>
#include <QBuffer>
#include <QFileDialog>
#include <QFileInfo>
#include <QJsonDocument>
#include <QMenu>
#include <QPainter>
#include <QPdfWriter>
#if __has_include(<QSvgGenerator>)
#include <QSvgGenerator>
#endif

namespace posewire::gui {

namespace {

constexpr std::size_t kMostValuesInFile = 20'000'000;

LineLanguage curveLanguage() {
    return {[](const std::string& text) {
                const auto signal = feed::parseSignal(text);
                return text.empty() || signal ? std::nullopt : std::optional(signal.error());
            },
            filter::signalCompletions, PlotsPanel::tr("Press Enter to plot"),
            PlotsPanel::tr("Alt and arrow down: earlier curves")};
}

QString setFilter() {
    return PlotsPanel::tr("Curves (*.json)");
}

} // namespace

PlotsPanel::PlotsPanel(model::SessionView& view, Commands& commands, Playback& playback, QWidget* parent)
    : Panel(view, commands, parent),
      m_plots(new PlotsView(view, commands, playback, this)),
      m_line(new FilterLine(m_problem, this, curveLanguage())) {
    m_live = m_bar->addCommand({}, tr("Live"), tr("Follow the stream again (L)"));
    const QAction* all = m_bar->addCommand({}, tr("All"), tr("Show all there is (0)"));
    const QAction* out = m_bar->addCommand({}, QStringLiteral("−"), tr("Zoom out (−)"));
    const QAction* in = m_bar->addCommand({}, QStringLiteral("+"), tr("Zoom in (+)"));
    m_range = m_bar->addCommand({}, tr("Selection"), tr("Show the selected range"));
    connect(m_live, &QAction::triggered, m_plots, &PlotsView::follow);
    connect(all, &QAction::triggered, this, &PlotsPanel::showAll);
    connect(out, &QAction::triggered, this, &PlotsPanel::zoomOut);
    connect(in, &QAction::triggered, this, &PlotsPanel::zoomIn);
    connect(m_range, &QAction::triggered, this, &PlotsPanel::showRange);
    layOut();
    connect(m_line, &FilterLine::applied, this, [this](const QString& text) {
        add({text});
        m_line->setApplied({});
    });
    connect(m_plots, &PlotsView::dropped, this, &PlotsPanel::add);
    connect(m_plots, &PlotsView::menuRequested, this, &PlotsPanel::showMenu);
    if (parent == nullptr || !parent->objectName().endsWith(QLatin1Char('2'))) {
        connect(&commands, &Commands::plotRequested, this, [this](const QStringList& curves) {
            if (&m_commands.session() == &m_view) {
                add(curves);
            }
        });
    }
}

void PlotsPanel::layOut() {
    const int margin = CellDelegate::margin(fontMetrics());
    auto* head = spacedRow({margin, margin / 2, margin, margin / 2}, margin / 2);
    head->addWidget(m_line, 1);
    head->addWidget(m_bar);
    m_line->setObjectName(QStringLiteral("plotLine"));
    m_line->setAccessibleName(tr("Field to plot"));
    m_line->setPlaceholderText(tr("Plot a field, such as position.z of Pelvis"));
    m_line->setMinimumWidth(fontMetrics().averageCharWidth() * 24); // the buttons give way first
    m_problem->setContentsMargins(margin, 0, margin, margin / 2);
    m_problem->setWordWrap(true);
    m_problem->hide();
    auto* column = tightColumn(this);
    column->addLayout(head);
    column->addWidget(m_problem);
    column->addWidget(new Line(this));
    column->addWidget(m_plots, 1);
    column->addWidget(m_message);
}

std::span<const ActionInfo> PlotsPanel::actionTable() {
    using Do = ActionsOf<PlotsPanel>;
    static constexpr const char* kMenu = QT_TRANSLATE_NOOP("Action", "&View/Plots");
    static constexpr ActionInfo kActions[] = {
        {"plotsZoomIn", kMenu, QT_TRANSLATE_NOOP("Action", "Zoom &in"), "", Do::call<&PlotsPanel::zoomIn>},
        {"plotsZoomOut", kMenu, QT_TRANSLATE_NOOP("Action", "Zoom &out"), "", Do::call<&PlotsPanel::zoomOut>},
        {"plotsShowAll", kMenu, QT_TRANSLATE_NOOP("Action", "&All there is"), "",
         Do::call<&PlotsPanel::showAll>},
        {"plotsShowRange", kMenu, QT_TRANSLATE_NOOP("Action", "The &selected range"), "",
         Do::call<&PlotsPanel::showRange>},
        lineIn(kMenu),
        {"plotsOpenSet", kMenu, QT_TRANSLATE_NOOP("Action", "Open &curves…"), "",
         Do::call<&PlotsPanel::openSet>},
        {"plotsSaveSet", kMenu, QT_TRANSLATE_NOOP("Action", "Sa&ve curves…"), "",
         Do::call<&PlotsPanel::saveSet>},
        {"plotsSave", kMenu, QT_TRANSLATE_NOOP("Action", "&Export picture or values…"), "",
         Do::call<&PlotsPanel::save>},
        {"plotsRemoveAll", kMenu, QT_TRANSLATE_NOOP("Action", "&Remove all curves"), "",
         Do::call<&PlotsPanel::removeAll>},
    };
    return kActions;
}

void PlotsPanel::refresh() {
    m_plots->refresh();
    m_live->setVisible(!m_view.isRecording());
    m_live->setEnabled(m_view.choices().cursor.mode == model::Cursor::Mode::Paused);
    m_range->setEnabled(m_view.choices().range.fixed.has_value());
}

QString PlotsPanel::summary() const {
    const auto count = static_cast<int>(m_plots->curves().count());
    const QString curves = count == 0 ? QString() : tr("%n curves", nullptr, count);
    return !m_plots->curves().isReading()
               ? curves
               : curves + tr(" · %1 % read").arg(static_cast<int>(m_plots->curves().share() * 100));
}

void PlotsPanel::showChanged() {
    m_plots->refresh();
    m_plots->updateGeometry();
    m_plots->setAccessibleDescription(tr("%n curves", nullptr, static_cast<int>(m_plots->curves().count())));
}

void PlotsPanel::restoreState(const QJsonObject& state) {
    m_plots->curves().restore(state);
    m_plots->updateGeometry();
}

void PlotsPanel::add(const QStringList& curves, std::optional<std::size_t> chart) {
    for (const QString& text : curves) {
        if (const auto problem = m_plots->curves().add(text, chart)) {
            m_message->say(fromUtf8(problem->text));
        }
    }
    showChanged();
}

void PlotsPanel::removeAll() {
    m_plots->curves().clear();
    showChanged();
}

void PlotsPanel::addCurveEntries(QMenu& menu, const PlotsView::Spot& spot, const QPoint& place) {
    const PlotChart& chart = m_plots->curves().charts()[spot.chart];
    const PlotCurve& curve = chart.curves[*spot.curve];
    const bool isInArea = m_plots->shown()[spot.chart].area.contains(place);
    const log::Stamp stamp = isInArea ? m_plots->stampAt(place.x()) : m_view.cursorStamp();
    const QString name = m_plots->nameOf(curve);
    menu.addAction(menuText(tr("Show the packet of %1").arg(name)), this, [this, spot, stamp] {
        if (!m_plots->showPacket(m_plots->curves().charts()[spot.chart].curves[*spot.curve], stamp)) {
            m_message->say(noPacketsText());
        }
    });
    menu.addAction(menuText(tr("%1 in a chart of its own").arg(name)), this,
                   [this, spot] {
                       m_plots->curves().moveApart(spot.chart, *spot.curve);
                       showChanged();
                   })
        ->setEnabled(chart.curves.size() > 1);
    menu.addAction(menuText(tr("Remove %1").arg(name)), this, [this, spot] {
        m_plots->curves().remove(spot.chart, *spot.curve);
        showChanged();
    });
    menu.addSeparator();
}

void PlotsPanel::showMenu(const QPoint& place, const QPoint& onScreen) {
    QMenu menu(this);
    const auto spot = m_plots->spotAt(place);
    if (spot && spot->curve) {
        addCurveEntries(menu, *spot, place);
    }
    if (spot) {
        const PlotChart& chart = m_plots->curves().charts()[spot->chart];
        QAction* log = menu.addAction(tr("Logarithmic axis"), this, [this, chart = spot->chart] {
            m_plots->curves().toggleLog(chart);
            showChanged();
        });
        log->setCheckable(true);
        log->setChecked(chart.isLog);
        menu.addAction(tr("Fit the axis to the values"), this,
                       [this, chart = spot->chart] {
                           m_plots->curves().setRange(chart, std::nullopt);
                           showChanged();
                       })
            ->setEnabled(chart.range.has_value());
        menu.addSeparator();
    }
    const bool hasCurves = m_plots->curves().count() != 0;
    menu.addAction(tr("Open curves…"), this, &PlotsPanel::openSet);
    menu.addAction(tr("Save curves…"), this, &PlotsPanel::saveSet)->setEnabled(hasCurves);
    menu.addAction(tr("Export picture or values…"), this, &PlotsPanel::save)->setEnabled(hasCurves);
    menu.addAction(tr("Remove all curves"), this, &PlotsPanel::removeAll)->setEnabled(hasCurves);
    menu.exec(onScreen);
}

void PlotsPanel::save() {
    QString kinds = tr("Picture (*.png);;Drawing (*.svg);;Document (*.pdf);;Values in view (*.csv)");
#if !__has_include(<QSvgGenerator>)
    kinds = tr("Picture (*.png);;Document (*.pdf);;Values in view (*.csv)");
#endif
    const QString path = askWhereToSave(this, tr("Export plots"), QStringLiteral("plots.png"), kinds);
    if (!path.isEmpty()) {
        const QString problem = saveTo(path);
        m_message->say(problem.isEmpty() ? tr("Saved: %1").arg(path) : problem);
    }
}

QString PlotsPanel::saveTo(const QString& path) {
    constexpr double kSharp = 2;
    const QString suffix = QFileInfo(path).suffix().toLower();
    QBuffer content;
    content.open(QIODevice::WriteOnly);
    if (suffix == QLatin1String("csv")) {
        const auto values = m_plots->curves().csv(m_plots->window(), kMostValuesInFile);
        return values ? saveFile(path, *values)
                      : tr("Not saved: there are too many values in view. Zoom in, or use `posewire-cli "
                           "query`.");
    }
#if __has_include(<QSvgGenerator>)
    if (suffix == QLatin1String("svg")) {
        QSvgGenerator drawing;
        drawing.setOutputDevice(&content);
        drawing.setSize(m_plots->size());
        drawing.setViewBox(m_plots->rect());
        drawing.setResolution(logicalDpiX());
        QPainter painter(&drawing);
        m_plots->paint(painter);
        painter.end();
        return saveFile(path, content.data());
    }
#endif
    if (suffix == QLatin1String("pdf")) {
        constexpr double kPoints = 72; // an inch
        QPdfWriter document(&content);
        document.setResolution(logicalDpiX());
        document.setPageSize(QPageSize(QSizeF(m_plots->size()) * kPoints / logicalDpiX(), QPageSize::Point));
        document.setPageMargins({});
        QPainter painter(&document);
        m_plots->paint(painter);
    } else {
        QPixmap picture(m_plots->size() * kSharp);
        picture.setDevicePixelRatio(kSharp);
        QPainter painter(&picture);
        m_plots->paint(painter);
        painter.end();
        return savePicture(picture, path);
    }
    return saveFile(path, content.data());
}

void PlotsPanel::saveSet() {
    const QString path = askWhereToSave(this, tr("Save curves"), QStringLiteral("curves.json"), setFilter());
    if (!path.isEmpty()) {
        const QString problem = saveFile(path, QJsonDocument(state()).toJson());
        m_message->say(problem.isEmpty() ? tr("Saved: %1").arg(path) : problem);
    }
}

void PlotsPanel::openSet() {
    const QString path = QFileDialog::getOpenFileName(this, tr("Open curves"), {}, setFilter());
    if (!path.isEmpty()) {
        m_message->say(openFrom(path));
    }
}

QString PlotsPanel::openFrom(const QString& path) {
    const auto read = readSmallFile(path).and_then(parseSmallObject);
    const QString name = QFileInfo(path).fileName();
    if (!read) {
        return tr("Cannot read %1: %2").arg(name, read.error());
    }
    PlotCurves checked(m_view);
    if (!checked.restore(*read)) {
        return tr("%1 has no curves.").arg(name);
    }
    restoreState(*read);
    showChanged();
    return {};
}

} // namespace posewire::gui
