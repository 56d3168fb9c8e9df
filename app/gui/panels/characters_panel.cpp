// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/characters_panel.h"

#include "app/gui/models/display_filter.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/theme.h"
#include "core/model/session/accounts.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"

#include <QApplication>
#include <QEvent>
#include <QItemSelectionModel>
#include <QMenu>
#include <QToolButton>

#include <algorithm>
#include <utility>

namespace posewire::gui {

/// Cells of lines that are lower where all have room then.
class BoardDelegate final : public CellDelegate {
public:
    using CellDelegate::CellDelegate;

    /// True where it is another height than before.
    bool setHeight(int height) { return std::exchange(m_height, height) != height; }
    [[nodiscard]] QSize sizeHint(const QStyleOptionViewItem& option,
                                 const QModelIndex& index) const override {
        const QSize hint = CellDelegate::sizeHint(option, index);
        return {hint.width(), m_height > 0 ? m_height : hint.height()};
    }

private:
    int m_height = 0;
};

/// Senders that others have taken over from, behind a line that counts them; hidden if there are none.
class EndedSenders final : public QWidget {
public:
    EndedSenders(model::SessionView& view, Commands& commands, QWidget* parent)
        : QWidget(parent), m_commands(commands), m_model(view) {
        m_toggle->setObjectName(QStringLiteral("endedSenders"));
        m_toggle->setCheckable(true);
        m_toggle->setFocusPolicy(Qt::StrongFocus);
        QToolButton* forget =
            flatButton(tr("Forget"), tr("Take ended senders out of all lists; sums keep them"), this);
        forget->setObjectName(QStringLiteral("forgetEnded"));
        forget->setFocusPolicy(Qt::StrongFocus);
        auto* row = spacedRow({4, 2, 8, 2}, 6);
        row->addWidget(m_toggle);
        row->addStretch(1);
        row->addWidget(forget);
        auto* column = tightColumn(this);
        column->addWidget(new Line(this));
        column->addLayout(row);
        m_table->setModel(&m_model);
        column->addWidget(m_table);
        m_table->hide();
        hide();
        connect(m_toggle, &QToolButton::clicked, this, &EndedSenders::refresh);
        connect(forget, &QToolButton::clicked, this, &EndedSenders::forgetAll);
        connect(m_table, &TableView::menuRequested, this, &EndedSenders::addActions);
    }

    void toggle() { m_toggle->click(); }
    [[nodiscard]] bool isOpen() const { return m_toggle->isChecked(); }

    void refresh() {
        constexpr int kMostRows = 4;
        m_model.refresh();
        const int count = m_model.rowCount();
        if (count == 0 && isAncestorOf(QApplication::focusWidget())) {
            parentWidget()->setFocus(); // else the next button would have the keyboard
        }
        setVisible(count != 0);
        m_table->setVisible(isOpen() && count != 0);
        const QString words = tr("%n ended senders", nullptr, count);
        m_toggle->setText((isOpen() ? QStringLiteral("▾ ") : QStringLiteral("▸ ")) + words);
        m_toggle->setAccessibleName(words);
        m_table->setFixedHeight(m_table->heightForRows(std::clamp(count, 1, kMostRows)));
    }

    void forgetAll() {
        for (const EndedSender& one : std::vector(m_model.rows())) {
            m_commands.forgetSender(one.sender);
        }
        refresh();
    }

private:
    void addActions(QMenu& menu, const QModelIndex& index) {
        if (index.isValid()) {
            const log::SenderId sender = m_model.rows()[static_cast<std::size_t>(index.row())].sender;
            connect(menu.addAction(tr("Forget")), &QAction::triggered, this,
                    [this, sender] { m_commands.forgetSender(sender); });
            menu.addSeparator();
        }
    }

    Commands& m_commands;
    EndedSenderModel m_model;
    QToolButton* m_toggle = flatButton({}, tr("Senders that others have taken over from"), this);
    TableView* m_table = new TableView(tr("Ended senders"), this);
};

namespace {

QToolButton* toggle(const QString& name, const QString& text, const QString& toolTip, QWidget* parent) {
    QToolButton* button = framedButton(text, toolTip, parent);
    button->setObjectName(name);
    button->setCheckable(true);
    button->setFocusPolicy(Qt::StrongFocus);
    return button;
}

using CharacterDo = ActionsOf<CharactersPanel>;

constexpr const char* kMenu = QT_TRANSLATE_NOOP("Action", "&View/C&haracters");

const ActionInfo kCharacterActions[] = {
    {"troubleFirst", kMenu, QT_TRANSLATE_NOOP("Action", "&Trouble first"), "",
     CharacterDo::call<&CharactersPanel::toggleTroubleFirst>,
     CharacterDo::is<&CharactersPanel::isTroubleFirst>},
    {"characterDetail", kMenu, QT_TRANSLATE_NOOP("Action", "&Detail of the selected"), "",
     CharacterDo::call<&CharactersPanel::toggleDetail>, CharacterDo::is<&CharactersPanel::isDetailShown>},
    {"frameCharacter", kMenu, QT_TRANSLATE_NOOP("Action", "&Frame selected"), "",
     CharacterDo::call<&CharactersPanel::frameSelected>},
    {"soloCharacter", kMenu, QT_TRANSLATE_NOOP("Action", "&Solo selected, or show all"), "",
     CharacterDo::call<&CharactersPanel::soloSelected>},
    {"toggleCharacter", kMenu, QT_TRANSLATE_NOOP("Action", "&Hide or show selected"), "",
     CharacterDo::call<&CharactersPanel::toggleSelected>},
    {"packetsOfCharacter", kMenu, QT_TRANSLATE_NOOP("Action", "&Packets of selected"), "",
     CharacterDo::call<&CharactersPanel::showPacketsOfSelected>},
    {"incidentsOfCharacter", kMenu, QT_TRANSLATE_NOOP("Action", "&Incidents of selected"), "",
     CharacterDo::call<&CharactersPanel::showIncidentsOfSelected>},
    {"showEnded", kMenu, QT_TRANSLATE_NOOP("Action", "&Ended senders"), "",
     CharacterDo::callIn<&CharactersPanel::ended, &EndedSenders::toggle>,
     CharacterDo::isIn<&CharactersPanel::ended, &EndedSenders::isOpen>},
    {"forgetEnded", kMenu, QT_TRANSLATE_NOOP("Action", "F&orget ended senders"), "",
     CharacterDo::callIn<&CharactersPanel::ended, &EndedSenders::forgetAll>},
};

} // namespace

std::span<const ActionInfo> CharactersPanel::actionTable() {
    return kCharacterActions;
}

CharactersPanel::CharactersPanel(model::SessionView& view, Commands& commands,
                                 const ReceivingState& receiving, QWidget* parent)
    : Panel(view, commands, parent),
      m_receiving(receiving),
      m_troubleFirst(toggle(QStringLiteral("troubleFirst"), tr("Trouble first"),
                            tr("The worst verdict on top; else in order of appearance"), this)),
      m_detailToggle(toggle(QStringLiteral("detail"), tr("Detail"),
                            tr("The streams of the selected character, and where they come from"), this)),
      m_span(new ElidedLabel(Qt::AlignRight | Qt::AlignVCenter, this)),
      m_rows(new BoardDelegate(m_table)),
      m_ended(new EndedSenders(view, commands, this)) {
    auto* column = tightColumn(this);
    auto* row = spacedRow({8, 3, 8, 3}, 6);
    row->addWidget(m_troubleFirst);
    row->addWidget(m_detailToggle);
    row->addStretch(1);
    row->addWidget(m_span);
    m_span->setObjectName(QStringLiteral("span"));
    row->setStretchFactor(m_span, 1);
    column->addLayout(row);
    connect(m_troubleFirst, &QToolButton::clicked, this, &CharactersPanel::setTroubleFirst);
    connect(m_detailToggle, &QToolButton::clicked, this, &CharactersPanel::setDetailShown);
    m_table->setObjectName(QStringLiteral("board"));
    m_table->setModel(&m_model);
    m_table->setItemDelegate(m_rows);
    setFocusProxy(m_table);
    new EventWatch(m_table->viewport(), QEvent::Resize, [this] { fitRows(); });
    column->addWidget(m_table, 1);

    auto* detail = tightColumn(m_detail);
    detail->addWidget(new Line(m_detail));
    m_history->setContentsMargins(8, 3, 8, 3);
    detail->addWidget(m_history);
    m_streams->setObjectName(QStringLiteral("characterStreams"));
    m_streams->setModel(&m_detailModel);
    detail->addWidget(m_streams);
    column->addWidget(m_detail);
    m_detail->hide();
    column->addWidget(m_ended);
    column->addWidget(m_message);

    showEmptyState();
    connect(m_table->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            &CharactersPanel::select);
    connect(m_table, &QAbstractItemView::doubleClicked, this, &CharactersPanel::frameSelected);
    connect(m_table, &TableView::menuRequested, this, &CharactersPanel::addActions);
}

void CharactersPanel::showEmptyState() {
    if (m_view.isRecording()) {
        m_table->setEmptyText(tr("No character in this recording."));
        return;
    }
    const std::vector<PortState>& ports = m_receiving.ports;
    if (ports.empty() && !m_receiving.stage.isEmpty()) {
        m_table->setEmptyText(tr("No character on the air.") + u'\n' + m_receiving.stageProblem);
        return;
    }
    if (ports.empty()) {
        m_table->setEmptyText(tr("No character on the air.\nThere is nothing to listen to: add an input "
                                 "(Input > Inputs)."));
        return;
    }
    const auto open =
        std::ranges::find_if(ports, [](const PortState& state) { return state.id.has_value(); });
    const auto port = open == ports.end() ? ports.front().port.port : open->status.endpoint.port;
    m_table->setEmptyText(
        tr("No character on the air.\nIn MVN: Options > Preferences > Network Streamer, add "
           "this computer with port %1 and tick the stream.")
            .arg(port));
}

void CharactersPanel::refresh() {
    m_isFollowing = true;
    m_model.refresh();
    showEmptyState();
    followSelection();
    m_isFollowing = false;
    const model::Unproven unproven = m_view.accounts().unproven();
    QString span = boardSpanText(m_view);
    if (unproven.characters != 0) {
        span += tr(" · %1 unconfirmed").arg(grouped(unproven.characters));
        m_span->setToolTip(toolTipText(tr("IDs of which too little came to believe that they are characters: "
                                          "corrupt datagrams may have invented them. Datagrams: %1.")
                                           .arg(grouped(unproven.datagrams))));
    } else {
        m_span->setToolTip(toolTipText(tr("The time that verdicts and columns of lost samples are of")));
    }
    m_span->setText({}, span);
    showDetail();
    m_ended->refresh();
    fitRows();
}

QString CharactersPanel::summary() const {
    const auto characters = m_view.atNow().roster().listed();
    if (characters.empty()) {
        return {};
    }
    const auto good = std::ranges::count_if(characters, [this](const model::Character* character) {
        return m_view.verdicts().of(character->key).state == model::TakeVerdict::State::Good;
    });
    return tr("%1 of %2 good").arg(good).arg(characters.size());
}

QJsonObject CharactersPanel::state() const {
    QJsonObject state = m_table->columns().state();
    state["troubleFirst"] = isTroubleFirst();
    state["detail"] = isDetailShown();
    return state;
}

void CharactersPanel::restoreState(const QJsonObject& state) {
    m_table->columns().restore(state);
    setTroubleFirst(state["troubleFirst"].toBool());
    setDetailShown(state["detail"].toBool());
}

void CharactersPanel::setTroubleFirst(bool isFirst) {
    m_troubleFirst->setChecked(isFirst);
    m_model.setOrder(isFirst ? BoardOrder::TroubleFirst : BoardOrder::Appearance);
    refresh();
}

void CharactersPanel::setDetailShown(bool isShown) {
    m_detailToggle->setChecked(isShown);
    refresh();
}

/// As high as its rows, but no higher than half of the dock.
void CharactersPanel::showDetail() {
    const auto key = selected();
    const bool isShown = isDetailShown() && key;
    if (isShown) {
        m_detailModel.refresh(key, m_model.nominalRates());
        QStringList parts{characterName(m_view, *key), restartWords(m_view.accounts().restartsOf(*key)),
                          portHistory(m_view, *key)};
        parts.removeAll(QString());
        m_history->setText(parts.join(QStringLiteral(" · ")));
        m_streams->setFixedHeight(
            std::min(m_streams->heightForRows(std::max(1, m_detailModel.rowCount())), height() / 2));
    }
    m_detail->setVisible(isShown);
}

/// Lines become lower, down to the height of the letters, so that as many performers as can be are in view.
void CharactersPanel::fitRows() {
    const int usual = CellDelegate::rowHeight(m_table->fontMetrics());
    const int least = m_table->fontMetrics().height() + 2;
    const int rows = std::max(1, m_model.rowCount());
    if (m_rows->setHeight(std::clamp(m_table->viewport()->height() / rows, least, usual))) {
        m_table->doItemsLayout();
    }
}

/// Rows may have changed places: the current one is that of the selection, wherever it is now.
void CharactersPanel::followSelection() {
    const model::Selection& selection = m_view.choices().selection;
    const QModelIndex wanted = selection.character ? m_model.indexOf(*selection.character) : QModelIndex();
    if (m_table->currentIndex().row() != wanted.row()) {
        m_table->setCurrentIndex(wanted);
    }
    if (!wanted.isValid()) {
        m_table->clearSelection();
    } else if (m_followed.character != selection.character) {
        m_table->scrollTo(wanted);
    }
    m_followed = selection;
}

std::optional<model::CharacterKey> CharactersPanel::selected() const {
    const auto& key = m_view.choices().selection.character;
    return key && m_view.roster().find(*key) != nullptr ? std::optional(m_view.atNow().roster().current(*key))
                                                        : std::nullopt;
}

std::optional<model::CharacterKey> CharactersPanel::selectedOrSay() const {
    const auto key = selected();
    m_message->say(key ? QString() : tr("No character is selected."));
    return key;
}

void CharactersPanel::select(const QModelIndex& index) {
    const auto key = m_model.character(index);
    if (!m_isFollowing && key) {
        m_commands.select(selectionOf(m_view, *key));
    }
}

bool CharactersPanel::isSolo(const model::CharacterKey& key) const {
    return std::ranges::all_of(m_view.atNow().roster().listed(), [&](const model::Character* one) {
        return m_view.roster().isHidden(one->key) != m_view.roster().isSame(one->key, key);
    });
}

void CharactersPanel::frameSelected() {
    if (const auto key = selectedOrSay()) {
        m_commands.frameCharacter(*key);
    }
}

void CharactersPanel::soloSelected() {
    const std::vector<const model::Character*> all = m_view.atNow().roster().listed();
    const bool isAnyHidden = std::ranges::any_of(
        all, [this](const model::Character* one) { return m_view.roster().isHidden(one->key); });
    const bool showsAll = !m_view.choices().selection.character && isAnyHidden;
    const auto key = showsAll ? std::nullopt : selectedOrSay();
    if (!showsAll && !key) {
        return;
    }
    const bool isAgain = key && isSolo(*key);
    for (const model::Character* one : all) {
        m_commands.setCharacterVisible(one->key,
                                       showsAll || isAgain || m_view.roster().isSame(one->key, *key));
    }
}

void CharactersPanel::toggleSelected() {
    if (const auto key = selectedOrSay()) {
        m_commands.setCharacterVisible(*key, m_view.roster().isHidden(*key));
    }
}

void CharactersPanel::showPacketsOfSelected() {
    if (const auto key = selectedOrSay()) {
        m_commands.setDisplayFilter(characterFilter(m_view, *key));
        m_commands.showDock(QStringLiteral("packets"));
    }
}

void CharactersPanel::showIncidentsOfSelected() {
    if (const auto key = selectedOrSay()) {
        m_commands.showIncident(m_view.verdicts().of(*key).incident, *key);
    }
}

void CharactersPanel::addActions(QMenu& menu, const QModelIndex& index) {
    const auto key = m_model.character(index);
    if (!key) {
        return;
    }
    m_commands.select(selectionOf(m_view, *key)); // what the entries are about
    const auto add = [&](const QString& text, void (CharactersPanel::*run)()) {
        connect(menu.addAction(text), &QAction::triggered, this, run);
    };
    add(tr("Frame"), &CharactersPanel::frameSelected);
    add(isSolo(*key) && m_model.rowCount() > 1 ? tr("Show all") : tr("Solo"), &CharactersPanel::soloSelected);
    add(m_view.roster().isHidden(*key) ? tr("Show") : tr("Hide"), &CharactersPanel::toggleSelected);
    menu.addSeparator();
    add(tr("Show packets"), &CharactersPanel::showPacketsOfSelected);
    add(tr("Show incidents"), &CharactersPanel::showIncidentsOfSelected);
    menu.addSeparator();
    QAction* forget =
        menu.addAction(tr("Forget sender %1").arg(shown(m_view.roster().addressOf(key->sender))));
    forget->setEnabled(m_view.accounts().isForgettable(key->sender));
    connect(forget, &QAction::triggered, this,
            [this, sender = key->sender] { m_commands.forgetSender(sender); });
    menu.addSeparator();
}

} // namespace posewire::gui
