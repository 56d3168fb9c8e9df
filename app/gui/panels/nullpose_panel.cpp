// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/nullpose_panel.h"

#include "app/gui/base/help_topics.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/help_link.h"
#include "core/model/session/roster.h"

#include <QItemSelectionModel>
#include <QMenu>

namespace posewire::gui {

namespace {

constexpr int kRoomyLines = 30; ///< high enough for the figure above the tables
constexpr double kNoticeShare = 0.3;

void setCurrentRow(TableView& table, int row) {
    if (row != table.currentIndex().row()) {
        table.setCurrentIndex(row < 0 ? QModelIndex() : table.model()->index(row, 0));
    }
}

} // namespace

NullPoseNotices::NullPoseNotices(QWidget* parent) : QTextBrowser(parent) {
    setAccessibleName(tr("Contradictions in scale messages"));
    setFrameShape(QFrame::NoFrame);
    setStyleSheet(QStringLiteral("QTextBrowser { border: none; border-radius: 0; padding: 0; }"));
    setOpenLinks(false);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    document()->setDocumentMargin(fontMetrics().height() * 0.35);
    connect(this, &QTextBrowser::anchorClicked, this,
            [this](const QUrl& url) { emit segmentPicked(url.path().toInt()); });
    for (const QEvent::Type look : {QEvent::PaletteChange, QEvent::FontChange}) {
        new EventWatch(this, look, [this] { write(); });
    }
}

void NullPoseNotices::setFindings(const std::vector<model::NullPoseFinding>& findings) {
    m_findings = findings;
    setVisible(!m_findings.empty());
    write();
}

void NullPoseNotices::write() {
    const Theme& colours = theme();
    QString html;
    for (const model::NullPoseFinding& finding : m_findings) {
        const Health health = healthOf(finding.severity());
        QString what = said(finding.fact, words::Form::Sentence).toHtmlEscaped();
        if (finding.segment >= 0) {
            what = QStringLiteral("<a href=\"%1\" style=\"color:%2;text-decoration:none\">%3</a>")
                       .arg(finding.segment)
                       .arg(colours.text.name(), what);
        }
        html += QStringLiteral("<p style=\"margin:0 0 %1px 0\"><span style=\"color:%2\">%3</span> "
                               "<span style=\"color:%4\">%5</span> <span style=\"color:%6\">%7</span></p>")
                    .arg(fontMetrics().height() / 3)
                    .arg(healthColour(health).name(), healthSymbol(health), colours.text.name(), what,
                         colours.dim.name(), said(finding.fact, words::Form::Advice).toHtmlEscaped());
    }
    setHtml(html);
}

void NullPoseNotices::fitHeight(int most) {
    document()->setTextWidth(viewport()->width());
    const int needed = static_cast<int>(document()->size().height()) + 2;
    setFixedHeight(std::clamp(needed, fontMetrics().height(), std::max(most, fontMetrics().height() * 3)));
}

NullPosePanel::NullPosePanel(model::SessionView& view, Commands& commands, QWidget* parent)
    : Panel(view, commands, parent),
      m_facts(nullPoseFacts(m_reading)),
      m_ghost(framedButton(tr("Ghost"), tr("Show the null pose over the live figure (Shift+G)"), this)),
      m_export(framedButton(tr("Export ▾"), tr("Save or copy what was sent, as CSV or JSON"), this)),
      m_comparison(new ElidedLabel(Qt::AlignRight | Qt::AlignVCenter, this)) {
    makeTables();
    makeButtons();
    layOut();
    connect(m_notices, &NullPoseNotices::segmentPicked, this, [this](int segment) {
        const int place = m_reading.places()[static_cast<std::size_t>(segment)];
        selectPlace(place >= 0 ? place : segment);
    });
    connect(m_figure, &NullPoseFigure::segmentPicked, this, &NullPosePanel::selectPlace);
    connect(m_figure, &NullPoseFigure::pointPicked, this, &NullPosePanel::selectPoint);
    new EventWatch(this, QEvent::Resize, [this] { arrange(); });
}

void NullPosePanel::makeTables() {
    m_segmentTable->setModel(&m_segments);
    m_pointTable->setModel(&m_points);
    m_lengthTable->setModel(&m_lengths);
    m_scaleTable->setModel(&m_scale);
    m_factTable->showFacts(m_facts);
    connect(m_segmentTable->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            [this](const QModelIndex& index) { selectPlace(index.row()); });
    connect(m_pointTable->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            [this](const QModelIndex& index) { selectPoint(index.row()); });
    connect(m_lengthTable->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            [this](const QModelIndex& index) {
                if (index.isValid()) {
                    selectPlace(m_reading.places()[static_cast<std::size_t>(m_lengths.segment(index.row()))]);
                }
            });
    connect(m_scaleTable->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            [this](const QModelIndex& index) {
                if (index.isValid() && m_reading.scale() != nullptr) {
                    const auto id = m_reading.scale()->segments[static_cast<std::size_t>(index.row())].id;
                    selectPlace(static_cast<int>(id) - 1);
                }
            });
}

void NullPosePanel::makeButtons() {
    m_ghost->setCheckable(true);
    connect(m_ghost, &QToolButton::clicked, this, [this](bool isOn) { m_commands.setGhostVisible(isOn); });
    m_export->setPopupMode(QToolButton::InstantPopup);
    auto* menu = new QMenu(m_export);
    for (const SheetFormat& format : exporting::formats<exporting::NullPoseSheet>()) {
        menu->addAction(tr("Save as &%1…").arg(QLatin1String(format.title)), this,
                        [this, &format] { chooseFile(format, fileFilter(format.kind, format.suffix)); });
    }
    menu->addSeparator();
    for (const SheetFormat& format : exporting::formats<exporting::NullPoseSheet>()) {
        menu->addAction(tr("Copy as %1").arg(QLatin1String(format.title)), this,
                        [this, &format] { copyAs(format); });
    }
    menu->addAction(tr("Copy the contradictions"), this, &NullPosePanel::copyContradictions);
    m_export->setMenu(menu);
}

void NullPosePanel::layOut() {
    auto* layout = tightColumn(this);
    auto* buttons = new QWidget(this);
    const int margin = CellDelegate::margin(fontMetrics());
    auto* row = spacedRow({margin, margin / 2, margin, margin / 2}, margin, buttons);
    row->addWidget(m_ghost);
    row->addWidget(m_export);
    m_tabs->setDocumentMode(true);
    m_tabs->addTab(m_segmentTable, tr("Segments"));
    m_tabs->addTab(m_pointTable, tr("Points"));
    m_tabs->addTab(m_lengthTable, tr("Lengths"));
    m_tabs->addTab(m_scaleTable, tr("Type 10"));
    m_overview->addWidget(m_figure);
    m_overview->addWidget(m_factTable);
    m_overview->setStretchFactor(0, 1);
    m_overview->setStretchFactor(1, 0);
    m_splitter->addWidget(m_overview);
    m_splitter->addWidget(m_tabs);
    for (QSplitter* splitter : {m_splitter, m_overview}) {
        splitter->setHandleWidth(1);
    }
    row->addWidget(m_comparison, 1);
    m_noticeLine->hide();
    layout->addWidget(m_notices);
    layout->addWidget(m_noticeLine);
    layout->addWidget(m_splitter, 1);
    layout->addWidget(new Line(this));
    layout->addWidget(buttons);
    m_notices->hide();
}

void NullPosePanel::refresh() {
    m_isFollowing = true;
    if (m_reading.refresh()) {
        m_point = -1;
        m_segments.refresh();
        m_points.refresh();
        m_lengths.refresh();
        m_scale.refresh();
        m_notices->setFindings(m_reading.findings());
        m_noticeLine->setVisible(!m_reading.findings().empty());
        showContent();
    }
    m_segmentTable->setEmptyText(emptyText());
    m_facts.refresh();
    m_ghost->setChecked(m_view.choices().isGhostShown);
    followSelection();
    arrange();
    m_isFollowing = false;
}

/// Hides tabs and parts that have nothing to show.
void NullPosePanel::showContent() {
    const bool hasPose = m_reading.pose() != nullptr;
    m_overview->setVisible(!m_reading.isEmpty());
    m_figure->setVisible(hasPose);
    m_export->setEnabled(!m_reading.isEmpty());
    const auto& height = m_reading.measures().height;
    m_comparison->setText({}, hasPose && height ? tr("ref: the reference body at %1 m").arg(fixed(*height, 3))
                                                : QString());
    m_ghost->setEnabled(hasPose);
    m_tabs->setTabVisible(m_tabs->indexOf(m_scaleTable), m_reading.scale() != nullptr);
    if (!hasPose && m_reading.scale() != nullptr) {
        m_tabs->setCurrentWidget(m_scaleTable);
    }
}

QString NullPosePanel::emptyText() const {
    if (!m_reading.character()) {
        return tr("No character on the air.\nThe null pose is a T-pose that gives the size of a performer's "
                  "segments. It is sent as type 13.");
    }
    return tr(
        "No null pose received.\nIt is a T-pose that gives the size of the segments, sent as type 13 (scale "
        "information).\n"
        "In MVN: Options > Preferences > Network Streamer.\nUntil it arrives, a body of 1.75 m is drawn.");
}

void NullPosePanel::followSelection() {
    const int place = m_reading.selectedPlace();
    const model::NullPose* pose = m_reading.pose();
    if (m_point >= 0) {
        const bool isItsOwn =
            pose != nullptr && m_point < static_cast<int>(pose->points.size()) &&
            pose->points[static_cast<std::size_t>(m_point)].segment == m_reading.segmentAt(place) + 1;
        m_point = isItsOwn ? m_point : -1;
    }
    setCurrentRow(*m_segmentTable, place);
    setCurrentRow(*m_pointTable, m_point);
    m_figure->mark(place, m_point);
}

void NullPosePanel::selectPlace(int place) {
    const auto& key = m_reading.character();
    if (m_isFollowing || place < 0 || !key) {
        return;
    }
    m_point = -1;
    m_commands.select(selectionOf(m_view, *key, m_reading.segmentAt(place)));
    m_figure->mark(place, -1);
}

void NullPosePanel::selectPoint(int point) {
    const auto& key = m_reading.character();
    if (m_isFollowing || point < 0 || !key) {
        return;
    }
    m_point = point;
    const auto& points = m_reading.pose()->points;
    m_commands.select(selectionOf(m_view, *key, points[static_cast<std::size_t>(point)].segment - 1));
    m_tabs->setCurrentWidget(m_pointTable);
    m_isFollowing = true;
    setCurrentRow(*m_pointTable, point);
    m_isFollowing = false;
    m_figure->mark(m_reading.selectedPlace(), point);
}

/// High docks show the figure above the tables; in low ones it is a tab.
void NullPosePanel::arrange() {
    const bool isRoomy = height() >= kRoomyLines * fontMetrics().height();
    if (isRoomy != m_isRoomy) {
        m_isRoomy = isRoomy;
        const bool isShown = !m_reading.isEmpty();
        if (isRoomy) {
            m_splitter->insertWidget(0, m_overview);
        } else {
            m_tabs->insertTab(0, m_overview, tr("Figure"));
        }
        m_overview->setVisible(isShown);
    }
    if (!isRoomy) {
        m_tabs->setTabVisible(m_tabs->indexOf(m_overview), !m_reading.isEmpty());
    }
    // Beside the figure the facts have the room they need; a narrow dock has them below it.
    const bool isWide = width() >= 30 * fontMetrics().height();
    const QString widest = tr("Props (11)") + QStringLiteral("00:00:00 · 99.9 s");
    m_factTable->setMinimumWidth(isWide ? QFontMetrics(tabularFont()).horizontalAdvance(widest) +
                                              5 * CellDelegate::margin(fontMetrics())
                                        : 0);
    m_overview->setOrientation(isWide ? Qt::Horizontal : Qt::Vertical);
    if (isRoomy && !m_isDivided && m_overview->isVisible()) {
        m_isDivided = true;
        m_splitter->setSizes({4, 5});
        m_overview->setSizes({10'000, 1}); // the facts take the least they need
    }
    if (!m_notices->isHidden()) {
        m_notices->fitHeight(static_cast<int>(height() * kNoticeShare));
    }
}

QString NullPosePanel::summary() const {
    if (m_reading.isEmpty()) {
        return {};
    }
    QStringList parts;
    if (m_reading.character()) {
        parts += characterName(m_view, *m_reading.character());
    }
    const auto count = [this](model::Severity severity) {
        return static_cast<int>(
            std::ranges::count(m_reading.findings(), severity, &model::NullPoseFinding::severity));
    };
    if (const int errors = count(model::Severity::Error); errors != 0) {
        parts += tr("%n errors", nullptr, errors);
    }
    if (const int warnings = count(model::Severity::Warning); warnings != 0) {
        parts += tr("%n warnings", nullptr, warnings);
    }
    return parts.join(QStringLiteral(" · "));
}

exporting::NullPoseSheet NullPosePanel::sheet() const {
    return {m_reading.character() ? m_view.roster().displayName(*m_reading.character())
                                  : model::ForeignText(),
            m_reading.pose(), m_reading.scale(), m_reading.props(),
            m_reading.pose() != nullptr ? m_view.wallOf(m_reading.pose()->stamp) : log::WallTime()};
}

QString NullPosePanel::save(const QString& path) const {
    return saveFile(path, exporting::formatFor<exporting::NullPoseSheet>(path.toStdString()).write(sheet()));
}

std::span<const ActionInfo> NullPosePanel::actionTable() {
    using Do = ActionsOf<NullPosePanel>;
    static constexpr const char* kCopy = QT_TRANSLATE_NOOP("Action", "&Edit/Copy n&ull pose");
    static constexpr ActionInfo kActions[] = {
        {"exportNullPose", "&File", QT_TRANSLATE_NOOP("Action", "Export nu&ll pose…"), "",
         Do::call<&NullPosePanel::exportFile>},
        {"copyNullPoseCsv", kCopy, QT_TRANSLATE_NOOP("Action", "As &CSV"), "",
         Do::call<&NullPosePanel::copyCsv>},
        {"copyNullPoseJson", kCopy, QT_TRANSLATE_NOOP("Action", "As &JSON"), "",
         Do::call<&NullPosePanel::copyJson>},
        {"copyContradictions", kCopy, QT_TRANSLATE_NOOP("Action", "Contra&dictions"), "",
         Do::call<&NullPosePanel::copyContradictions>},
    };
    return kActions;
}

void NullPosePanel::exportFile() {
    chooseFile(exporting::formats<exporting::NullPoseSheet>()[0], fileFilters<exporting::NullPoseSheet>());
}

void NullPosePanel::chooseFile(const SheetFormat& format, const QString& filters) {
    const std::string name = sheet().character.fileName("Character");
    const QString path = askWhereToSave(
        this, tr("Save null pose"),
        QStringLiteral("%1 null pose.%2").arg(fromUtf8(name), QLatin1String(format.suffix)), filters);
    const QString problem = path.isEmpty() ? QString() : save(path);
    if (!problem.isEmpty()) {
        MessageBox box(tr("Save null pose"), problem, QMessageBox::Ok, this);
        offerHelp(box, placeOf(HelpTopic::SavingFailed));
        box.exec();
    }
}

} // namespace posewire::gui
