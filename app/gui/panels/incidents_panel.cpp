// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/incidents_panel.h"

#include "app/gui/base/saving.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/help_link.h"
#include "core/model/session/verdict.h"

#include <QEvent>
#include <QHeaderView>
#include <QJsonArray>
#include <QKeyEvent>
#include <QMenu>
#include <QScopedValueRollback>
#include <QScrollBar>

#include <utility>

namespace posewire::gui {

namespace {

QJsonArray flagsOf(std::span<const bool> flags) {
    QJsonArray array;
    for (const bool flag : flags) {
        array.append(flag);
    }
    return array;
}

/// Flags that are not there stay as they are.
void readFlags(const QJsonValue& value, std::span<bool> flags) {
    const QJsonArray array = value.toArray();
    for (std::size_t i = 0; i < flags.size(); ++i) {
        flags[i] = array.at(static_cast<qsizetype>(i)).toBool(flags[i]);
    }
}

using Severity = model::IncidentSeverity;
using Group = model::IncidentGroup;
constexpr const char* kGroups = QT_TRANSLATE_NOOP("Action", "&View/&Incidents/&Groups");

bool listsCurrent(const IncidentsPanel& panel) {
    return panel.filter().onlyCurrent;
}

template <bool onlyCurrent>
void listCurrent(IncidentsPanel& panel) {
    IncidentModel::Filter filter = panel.filter();
    filter.onlyCurrent = onlyCurrent;
    panel.setFilter(filter);
}

constexpr auto kSeverityFlags = &IncidentModel::Filter::severities;
constexpr auto kGroupFlags = &IncidentModel::Filter::groups;

template <auto flags, auto which>
bool lists(const IncidentsPanel& panel) {
    return (panel.filter().*flags)[static_cast<std::size_t>(which)];
}

template <auto flags, auto which>
void toggle(IncidentsPanel& panel) {
    IncidentModel::Filter filter = panel.filter();
    bool& isListed = (filter.*flags)[static_cast<std::size_t>(which)];
    isListed = !isListed;
    panel.setFilter(filter);
}

template <auto flags, auto which>
constexpr ActionInfo flagEntry(const char* id, const char* menu, const char* text) {
    using Do = ActionsOf<IncidentsPanel>;
    return {id, menu, text, "", Do::call<toggle<flags, which>>, Do::is<lists<flags, which>>};
}

constexpr const char* kList = QT_TRANSLATE_NOOP("Action", "&View/&Incidents");

bool asksForNewest(const QEvent& event) {
    const bool isKey = event.type() == QEvent::KeyPress || event.type() == QEvent::ShortcutOverride;
    return isKey && static_cast<const QKeyEvent&>(event).key() == Qt::Key_End &&
           static_cast<const QKeyEvent&>(event).modifiers() == Qt::ControlModifier;
}

} // namespace

IncidentsPanel::IncidentsPanel(model::SessionView& view, Commands& commands, QWidget* parent)
    : Panel(view, commands, parent) {
    auto* column = tightColumn(this);
    column->addWidget(m_bar);
    column->addWidget(new Line(this));
    column->addWidget(m_table, 1);
    column->addWidget(m_message);
    m_chip->setObjectName(QStringLiteral("newestEvent"));
    m_chip->setFocusPolicy(Qt::NoFocus); // Ctrl+End does the same
    m_chip->setToolTip(tr("Go to the newest incident and follow (Ctrl+End)"));
    m_chip->hide();
    m_table->setModel(&m_incidents);
    m_table->setRootIsDecorated(true);
    connectParts();
    showEmptyState();
}

std::span<const ActionInfo> IncidentsPanel::actionTable() {
    using Do = ActionsOf<IncidentsPanel>;
    static constexpr ActionInfo kActions[] = {
        {"currentIncidents", kList, QT_TRANSLATE_NOOP("Action", "&Current"), "", Do::call<listCurrent<true>>,
         Do::is<listsCurrent>},
        {"incidentHistory", kList, QT_TRANSLATE_NOOP("Action", "&History"), "", Do::call<listCurrent<false>>,
         Do::is<listsCurrent, false>},
        lineIn(kList),
        flagEntry<kSeverityFlags, Severity::Error>("listErrors", kList,
                                                   QT_TRANSLATE_NOOP("Action", "&Errors")),
        flagEntry<kSeverityFlags, Severity::Warning>("listWarnings", kList,
                                                     QT_TRANSLATE_NOOP("Action", "&Warnings")),
        flagEntry<kSeverityFlags, Severity::Info>("listNotes", kList, QT_TRANSLATE_NOOP("Action", "&Notes")),
        lineIn(kList),
        flagEntry<kGroupFlags, Group::Sender>("listSenderIncidents", kGroups,
                                              QT_TRANSLATE_NOOP("Action", "&Sender")),
        flagEntry<kGroupFlags, Group::Loss>("listLossIncidents", kGroups,
                                            QT_TRANSLATE_NOOP("Action", "&Loss")),
        flagEntry<kGroupFlags, Group::Content>("listContentIncidents", kGroups,
                                               QT_TRANSLATE_NOOP("Action", "&Content")),
        flagEntry<kGroupFlags, Group::Limit>("listLimitIncidents", kGroups,
                                             QT_TRANSLATE_NOOP("Action", "L&imit")),
        {"markIncidentsSeen", kList, QT_TRANSLATE_NOOP("Action", "&Mark all as seen"), "",
         Do::call<&IncidentsPanel::markSeen>},
        {"exportEvents", QT_TRANSLATE_NOOP("Action", "&File"),
         QT_TRANSLATE_NOOP("Action", "Export &incidents…"), "", Do::call<&IncidentsPanel::exportFile>},
        {"onlyIncident", "&Go", QT_TRANSLATE_NOOP("Action", "Show only the &incident's packets"),
         "Ctrl+Return", Do::call<&IncidentsPanel::showOnlyCurrent>},
        {"incidentMeaning", "&Help", QT_TRANSLATE_NOOP("Action", "What the selected &incident means"), "",
         Do::call<&IncidentsPanel::explain>},
    };
    return kActions;
}

void IncidentsPanel::connectParts() {
    connect(m_bar, &IncidentBar::filterChanged, this, &IncidentsPanel::applyFilter);
    connect(m_bar, &IncidentBar::seenRequested, this, &IncidentsPanel::markSeen);
    connect(m_bar, &IncidentBar::exportRequested, this, &IncidentsPanel::exportFile);
    connect(m_bar, &IncidentBar::left, m_table, qOverload<>(&QWidget::setFocus));
    connect(m_table, &QAbstractItemView::activated, this, [this](const QModelIndex& row) { jump(row); });
    connect(m_table, &TableView::menuRequested, this, &IncidentsPanel::addActions);
    connect(m_table->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            [this](const QModelIndex& index) {
                const auto line = m_isRefreshing ? std::nullopt : m_incidents.line(index);
                if (line) {
                    m_current = line->incident().number;
                    setFollowing(false);
                }
            });
    connect(m_table->verticalScrollBar(), &QScrollBar::valueChanged, this, [this](int value) {
        if (!m_isRefreshing) {
            setFollowing(value == m_table->verticalScrollBar()->maximum() && !m_current);
        }
    });
    connect(&m_incidents, &QAbstractItemModel::rowsInserted, this,
            [this](const QModelIndex& parent, int first, int last) {
                m_missed += parent.isValid() ? 0 : last - first + 1;
            });
    connect(m_chip, &QPushButton::clicked, this, &IncidentsPanel::newest);
    m_table->installEventFilter(this);
    m_table->header()->installEventFilter(this);
}

void IncidentsPanel::refresh() {
    const QScopedValueRollback guard(m_isRefreshing, true);
    m_incidents.refresh();
    m_bar->showCounts(m_incidents.counts());
    showAskedFor();
    keepCurrent();
    showEmptyState();
    if (m_isFollowing) {
        m_missed = 0;
        m_table->scrollToBottom();
    }
    placeChip();
}

/// Its table is hidden when it goes, and would tell of a scroll bar that moved.
IncidentsPanel::~IncidentsPanel() {
    m_table->verticalScrollBar()->disconnect(this);
}

void IncidentsPanel::showAskedFor() {
    const model::IncidentRequest& request = m_view.choices().incidentRequest;
    if (std::exchange(m_requests, request.count) == request.count) {
        return;
    }
    if (request.of) {
        IncidentModel::Filter filter;
        filter.text = characterName(m_view, *request.of);
        setFilter(filter);
    }
    if (!request.number) {
        return;
    }
    if (!m_incidents.indexOf(*request.number).isValid()) {
        setFilter({}); // it would hide what was asked for
    }
    if (const QModelIndex row = m_incidents.indexOf(*request.number); row.isValid()) {
        m_current = request.number;
        setFollowing(false);
        m_table->setCurrentIndex(row);
        m_table->scrollTo(m_table->currentIndex(), QAbstractItemView::PositionAtCenter);
    }
}

/// A reset of the model takes the current row.
void IncidentsPanel::keepCurrent() {
    if (!m_current || m_table->currentIndex().isValid()) {
        return;
    }
    if (const QModelIndex row = m_incidents.indexOf(*m_current); row.isValid()) {
        m_table->setCurrentIndex(row);
    }
}

void IncidentsPanel::applyFilter(const IncidentModel::Filter& filter) {
    const QScopedValueRollback guard(m_isRefreshing, true);
    m_incidents.setFilter(filter);
    m_missed = 0;
    keepCurrent();
    showEmptyState();
    placeChip();
}

void IncidentsPanel::setFollowing(bool isFollowing) {
    if (isFollowing != m_isFollowing) {
        m_isFollowing = isFollowing;
        m_missed = 0;
        placeChip();
    }
}

void IncidentsPanel::newest() {
    m_current.reset();
    m_table->selectionModel()->clear();
    m_table->scrollToBottom();
    setFollowing(true);
}

void IncidentsPanel::placeChip() {
    m_chip->setVisible(!m_isFollowing && m_incidents.rowCount() > 0);
    const QString count = grouped(static_cast<std::uint64_t>(m_missed));
    // In the line of column titles it covers no row.
    m_table->columns().seat(*m_chip, m_missed == 0
                                         ? QStringList{tr("↓ Follow"), tr("↓")}
                                         : QStringList{tr("↓ %1 new").arg(count), tr("↓ %1").arg(count)});
}

void IncidentsPanel::showEmptyState() {
    const bool isAll = m_view.verdicts().incidents().all().empty();
    const IncidentModel::Filter& filter = m_incidents.filter();
    m_table->setEmptyText(
        isAll ? tr("No incidents.\nLosses and whose they are, outages, restarts, malformed data, changes and "
                   "exceeded limits are listed here.")
        : filter.onlyCurrent && m_incidents.counts().current == 0
            ? tr("No incident goes on now. Earlier ones are under History.")
            : tr("No incident matches the filter."));
}

void IncidentsPanel::jump(const QModelIndex& index, PacketLook look) {
    const auto line = m_incidents.line(index);
    if (line &&
        !showPackets(m_view, m_commands, packetsBehind(m_view, line->incident(), line->part()), look)) {
        m_message->say(noPacketsText());
    }
}

void IncidentsPanel::showOnlyCurrent() {
    if (m_table->currentIndex().isValid()) {
        jump(m_table->currentIndex(), PacketLook::Alone);
    } else {
        m_message->say(tr("No incident is selected."));
    }
}

void IncidentsPanel::explain() {
    if (const auto line = m_incidents.line(m_table->currentIndex())) {
        openHelp(helpPlaceOf(line->incident()));
    } else {
        m_message->say(tr("No incident is selected."));
    }
}

void IncidentsPanel::addActions(QMenu& menu, const QModelIndex& index) {
    if (index.isValid()) {
        const QPersistentModelIndex row(index);
        menu.addAction(tr("Show the packets"), this, [this, row] { jump(row); });
        menu.addAction(tr("Show only these packets"), this, [this, row] { jump(row, PacketLook::Alone); });
        menu.addAction(tr("What this means"), this, &IncidentsPanel::explain);
        menu.addSeparator();
    }
    menu.addAction(tr("Mark all as seen"), this, &IncidentsPanel::markSeen);
    menu.addAction(tr("Export…"), this, &IncidentsPanel::exportFile);
    menu.addSeparator();
    for (const auto& format : exporting::formats<exporting::EventSheet>()) {
        const QString text = tr("Copy all as %1").arg(QLatin1String(format.title));
        menu.addAction(text, this, [this, write = format.write] {
            copyText(QString::fromStdString(write({m_view, m_incidents.listed()})));
        });
    }
}

void IncidentsPanel::exportFile() {
    const QString path = askWhereToSave(this, tr("Export incidents"), QStringLiteral("incidents.csv"),
                                        fileFilters<exporting::EventSheet>());
    if (!path.isEmpty()) {
        const QString problem = save(path);
        m_message->say(problem.isEmpty() ? tr("Saved %1").arg(path) : problem);
    }
}

QString IncidentsPanel::save(const QString& path) {
    const auto& format = exporting::formatFor<exporting::EventSheet>(path.toStdString());
    return saveFile(path, format.write({m_view, m_incidents.listed()}));
}

QString IncidentsPanel::summary() const {
    const IncidentModel::Counts counts = m_incidents.counts();
    if (counts.all == 0) {
        return {};
    }
    const QString text = tr("%1 now · %2").arg(grouped(counts.current), grouped(counts.all));
    return counts.unseen == 0 || counts.unseen == counts.all
               ? text
               : text + QStringLiteral(" · ") + tr("%1 new").arg(grouped(counts.unseen));
}

QJsonObject IncidentsPanel::state() const {
    QJsonObject state = m_table->columns().state();
    const IncidentModel::Filter& filter = m_incidents.filter();
    const IncidentModel::Filter shipped;
    if (filter.onlyCurrent) {
        state["current"] = true;
    }
    if (filter.severities != shipped.severities) {
        state["severities"] = flagsOf(filter.severities);
    }
    if (filter.groups != shipped.groups) {
        state["groups"] = flagsOf(filter.groups);
    }
    return state;
}

void IncidentsPanel::restoreState(const QJsonObject& state) {
    IncidentModel::Filter filter;
    filter.onlyCurrent = state["current"].toBool();
    readFlags(state["severities"], filter.severities);
    readFlags(state["groups"], filter.groups);
    m_bar->setFilter(filter);
    m_table->columns().restore(state);
}

bool IncidentsPanel::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::Resize) {
        placeChip();
    } else if (watched == m_table && asksForNewest(*event)) {
        // The window's own Ctrl+End goes to the newest packet; here it goes to the newest incident.
        if (event->type() == QEvent::KeyPress) {
            newest();
        }
        event->accept();
        return true;
    }
    return Panel::eventFilter(watched, event);
}

} // namespace posewire::gui
