// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/events_panel.h"

#include "app/gui/models/text.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/saving.h"

#include <QEvent>
#include <QHeaderView>
#include <QJsonArray>
#include <QKeyEvent>
#include <QMenu>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QScrollBar>

namespace posewire::gui {

namespace {

constexpr int kMessageMs = 6000;

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

bool isEnd(const QEvent& event) {
    const bool isKey = event.type() == QEvent::KeyPress || event.type() == QEvent::ShortcutOverride;
    return isKey && static_cast<const QKeyEvent&>(event).key() == Qt::Key_End &&
           static_cast<const QKeyEvent&>(event).modifiers() == Qt::NoModifier;
}

} // namespace

EventsPanel::EventsPanel(model::SessionView& view, Commands& commands, QWidget* parent)
    : Panel(view, commands, parent),
      m_events(view),
      m_bar(new EventBar(this)),
      m_table(new TableView(tr("Events"), commands, this)),
      m_chip(new QPushButton(m_table)),
      m_message(new PassingMessage(kMessageMs, this)) {
    auto* column = tightColumn(this);
    column->addWidget(m_bar);
    column->addWidget(new Line(this));
    column->addWidget(m_table, 1);
    column->addWidget(m_message);
    m_chip->setObjectName(QStringLiteral("newestEvent"));
    m_chip->setFocusPolicy(Qt::NoFocus); // the End key does the same
    m_chip->setToolTip(tr("Go to the newest event and follow (End)"));
    m_chip->hide();
    m_message->setForegroundRole(QPalette::PlaceholderText);
    m_message->setContentsMargins(10, 3, 10, 4);
    m_table->setModel(&m_events);
    m_table->setColumnSamples(
        {QStringLiteral("▲ warning"), QStringLiteral("10:42:17.508"), QStringLiteral("192.168.10.21:52011"),
         QString(), QStringLiteral("99 999"), QStringLiteral("character conflict"), QStringLiteral("Content"),
         QStringLiteral("lasts")},
        QStringLiteral("14 samples lost in 13 gaps, cause: network. Type 23 brought sample"));
    m_table->setOptionalColumns(EventModel::kCount);
    connectParts();
    showEmptyState();
}

std::span<const ActionInfo> EventsPanel::actionTable() {
    static constexpr ActionInfo kActions[] = {
        {"exportEvents", QT_TRANSLATE_NOOP("Action", "&File"), QT_TRANSLATE_NOOP("Action", "Export &events…"),
         "", ActionsOf<EventsPanel>::call<&EventsPanel::exportFile>},
    };
    return kActions;
}

void EventsPanel::connectParts() {
    connect(m_bar, &EventBar::filterChanged, this, &EventsPanel::applyFilter);
    connect(m_bar, &EventBar::seenRequested, this, &EventsPanel::markSeen);
    connect(m_bar, &EventBar::exportRequested, this, &EventsPanel::exportFile);
    connect(m_bar, &EventBar::left, m_table, qOverload<>(&QWidget::setFocus));
    connect(m_table, &QAbstractItemView::activated, this, &EventsPanel::jump);
    connect(m_table, &TableView::menuRequested, this, &EventsPanel::addActions);
    connect(m_table->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            [this](const QModelIndex& index) {
                const model::Incident* event = m_isRefreshing ? nullptr : m_events.event(index);
                if (event != nullptr) {
                    m_currentEvent = event->number;
                    setFollowing(false);
                }
            });
    connect(m_table->verticalScrollBar(), &QScrollBar::valueChanged, this, [this](int value) {
        if (!m_isRefreshing) {
            setFollowing(value == m_table->verticalScrollBar()->maximum() && !m_currentEvent);
        }
    });
    connect(&m_events, &QAbstractItemModel::rowsInserted, this,
            [this](const QModelIndex&, int first, int last) { m_missed += last - first + 1; });
    connect(m_chip, &QPushButton::clicked, this, &EventsPanel::newest);
    m_table->installEventFilter(this);
    m_table->header()->installEventFilter(this);
}

void EventsPanel::refresh() {
    const QScopedValueRollback guard(m_isRefreshing, true);
    m_events.refresh();
    m_bar->showCounts(m_events.counts());
    showAskedFor();
    keepCurrent();
    showEmptyState();
    if (m_isFollowing) {
        m_missed = 0;
        m_table->scrollToBottom();
    }
    placeChip();
}

/// What somebody elsewhere asked for, once.
void EventsPanel::showAskedFor() {
    const std::optional<std::uint64_t> incident = m_view.selection().incident;
    if (std::exchange(m_askedFor, incident) == incident || !incident) {
        return;
    }
    if (const int row = m_events.rowOf(*incident); row >= 0) {
        m_currentEvent = incident;
        setFollowing(false);
        m_table->setCurrentIndex(m_events.index(row, 0));
        m_table->scrollTo(m_table->currentIndex(), QAbstractItemView::PositionAtCenter);
    }
}

/// A reset of the model takes the current row.
void EventsPanel::keepCurrent() {
    if (!m_currentEvent || m_table->currentIndex().isValid()) {
        return;
    }
    const int row = m_events.rowOf(*m_currentEvent);
    if (row >= 0) {
        m_table->setCurrentIndex(m_events.index(row, 0));
    }
}

void EventsPanel::applyFilter(const EventModel::Filter& filter) {
    const QScopedValueRollback guard(m_isRefreshing, true);
    m_events.setFilter(filter);
    m_missed = 0;
    keepCurrent();
    showEmptyState();
    placeChip();
}

void EventsPanel::setFollowing(bool isFollowing) {
    if (isFollowing != m_isFollowing) {
        m_isFollowing = isFollowing;
        m_missed = 0;
        placeChip();
    }
}

void EventsPanel::newest() {
    m_currentEvent.reset();
    m_table->selectionModel()->clear();
    m_table->scrollToBottom();
    setFollowing(true);
}

void EventsPanel::placeChip() {
    const QHeaderView* header = m_table->header();
    m_chip->setVisible(!m_isFollowing && m_events.rowCount() > 0);
    m_chip->setText(m_missed == 0 ? tr("↓ Follow")
                                  : tr("↓ %1 new").arg(grouped(static_cast<std::uint64_t>(m_missed))));
    // In the line of column titles it covers no row.
    m_chip->resize(m_chip->sizeHint().width(), header->height() - 2);
    m_chip->move(header->geometry().right() - m_chip->width(), header->y());
    m_chip->raise();
}

void EventsPanel::showEmptyState() {
    const bool isAll = m_view.incidents().all().empty();
    const EventModel::Filter& filter = m_events.filter();
    m_table->setEmptyText(isAll ? tr("Nothing has happened yet.\nGaps and their causes, restarts, malformed "
                                     "data, changes and exceeded limits are listed here.")
                          : filter.onlyCurrent && m_events.counts().current == 0
                              ? tr("No event lasts now. Earlier events are under History.")
                              : tr("No event matches the filter."));
}

void EventsPanel::jump(const QModelIndex& index) {
    const model::Incident* event = m_events.event(index);
    if (event != nullptr && !showPacketsOf(m_view, m_commands, *event)) {
        m_message->say(tr("The packets of this event are no longer in memory."));
    }
}

void EventsPanel::addActions(QMenu& menu, const QModelIndex& index) {
    if (index.isValid()) {
        const QPersistentModelIndex row(index);
        menu.addAction(tr("Show its packets"), this, [this, row] { jump(row); });
        menu.addSeparator();
    }
    menu.addAction(tr("Mark all as seen"), this, &EventsPanel::markSeen);
    menu.addAction(tr("Export…"), this, &EventsPanel::exportFile);
    menu.addSeparator();
    for (const auto& format : exporting::formats<exporting::EventSheet>()) {
        const QString text = tr("Copy all as %1").arg(QLatin1String(format.title));
        menu.addAction(text, this, [this, write = format.write] {
            m_commands.copyText(QString::fromStdString(write({m_view, m_events.listed()})));
        });
    }
}

void EventsPanel::exportFile() {
    const QString path = askWhereToSave(this, tr("Export events"), QStringLiteral("events.csv"),
                                        fileFilters<exporting::EventSheet>());
    if (!path.isEmpty()) {
        const QString problem = save(path);
        m_message->say(problem.isEmpty() ? tr("Saved %1").arg(path) : problem);
    }
}

QString EventsPanel::save(const QString& path) {
    const auto& format = exporting::formatFor<exporting::EventSheet>(path.toStdString());
    return saveFile(path, format.write({m_view, m_events.listed()}));
}

QString EventsPanel::summary() const {
    const EventModel::Counts counts = m_events.counts();
    if (counts.all == 0) {
        return {};
    }
    const QString text = tr("%1 current · %2").arg(grouped(counts.current), grouped(counts.all));
    return counts.unseen == 0 || counts.unseen == counts.all
               ? text
               : text + QStringLiteral(" · ") + tr("%1 new").arg(grouped(counts.unseen));
}

QJsonObject EventsPanel::state() const {
    QJsonObject state = m_table->columns().state();
    const EventModel::Filter& filter = m_events.filter();
    const EventModel::Filter shipped;
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

void EventsPanel::restoreState(const QJsonObject& state) {
    EventModel::Filter filter;
    filter.onlyCurrent = state["current"].toBool();
    readFlags(state["severities"], filter.severities);
    readFlags(state["groups"], filter.groups);
    m_bar->setFilter(filter);
    m_table->columns().restore(state);
}

bool EventsPanel::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::Resize) {
        placeChip();
    } else if (watched == m_table && isEnd(*event)) {
        // The window's own End goes back to live; here it goes to the newest event.
        if (event->type() == QEvent::KeyPress) {
            newest();
        }
        event->accept();
        return true;
    }
    return Panel::eventFilter(watched, event);
}

} // namespace posewire::gui
