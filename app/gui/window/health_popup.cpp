// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/health_popup.h"

#include "app/gui/models/incident_words.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/theme/words.h"
#include "core/model/session/accounts.h"
#include "core/model/session/verdict.h"

#include <QAbstractButton>
#include <QPainter>
#include <QPushButton>
#include <QScreen>
#include <QVBoxLayout>

#include <algorithm>

namespace posewire::gui {

namespace {

/// More would be a list: that is in the dock of events.
constexpr std::size_t kMostLines = 6;

/// A few lines of text behind the mark of its severity, with a dim note below; a button by mouse and
/// keyboard.
class TroubleLine final : public QAbstractButton {
public:
    TroubleLine(Health level, const QString& text, const QString& note, QWidget* parent)
        : QAbstractButton(parent), m_level(level), m_note(note) {
        setObjectName(QStringLiteral("trouble"));
        setText(text);
        setAccessibleName(text);
        setAccessibleDescription(note);
        setFocusPolicy(Qt::StrongFocus);
        setCursor(Qt::PointingHandCursor);
        setAttribute(Qt::WA_Hover);
        QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Minimum);
        policy.setHeightForWidth(true);
        setSizePolicy(policy);
    }

    [[nodiscard]] bool hasHeightForWidth() const override { return true; }
    [[nodiscard]] int heightForWidth(int width) const override {
        constexpr int kTallest = 10'000;
        const QRect room(0, 0, width - markWidth() - 2 * margin(), kTallest);
        const int text = fontMetrics().boundingRect(room, Qt::TextWordWrap, this->text()).height();
        return text + fontMetrics().lineSpacing() + 2 * margin();
    }

    [[nodiscard]] QSize sizeHint() const override {
        const int width = fontMetrics().averageCharWidth() * 56;
        return {width, heightForWidth(width)};
    }

protected:
    void paintEvent(QPaintEvent* /*event*/) override {
        QPainter painter(this);
        painter.setRenderHint(QPainter::Antialiasing);
        if (hasFocus() || underMouse()) {
            painter.setPen(hasFocus() ? theme().accent : theme().line);
            painter.setBrush(theme().raised);
            painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 4, 4);
        }
        QRect room = rect().adjusted(margin(), margin(), -margin(), -margin());
        painter.setPen(healthColour(m_level));
        painter.drawText(room, Qt::AlignLeft | Qt::AlignTop, healthSymbol(m_level));
        room.setLeft(room.left() + markWidth());
        painter.setPen(theme().text);
        painter.drawText(room, Qt::TextWordWrap | Qt::AlignLeft | Qt::AlignTop, text());
        painter.setPen(theme().dim);
        painter.drawText(room, Qt::AlignLeft | Qt::AlignBottom, m_note);
    }

private:
    [[nodiscard]] int margin() const { return fontMetrics().height() / 3; }
    [[nodiscard]] int markWidth() const {
        return fontMetrics().horizontalAdvance(healthSymbol(m_level) + QStringLiteral("  "));
    }

    Health m_level;
    QString m_note;
};

void paintFrame(QWidget& popup) {
    QPainter painter(&popup);
    painter.setPen(theme().line);
    painter.setBrush(theme().panel);
    painter.drawRect(popup.rect().adjusted(0, 0, -1, -1));
}

/// Over a widget at the bottom of the window.
void showAbove(QWidget& popup, const QWidget& widget) {
    popup.adjustSize();
    const QRect room = widget.screen()->availableGeometry();
    QPoint place = widget.mapToGlobal(QPoint(0, -popup.height() - 4));
    place.setX(std::clamp(place.x(), room.left(), std::max(room.left(), room.right() - popup.width())));
    place.setY(std::max(place.y(), room.top()));
    popup.move(place);
    popup.show();
}

/// Says of one character why it is as it is: figures of the last seconds, and what is wrong. Each line
/// leads to its packets. Deletes itself when it is closed: by a click elsewhere or Escape.
class HealthPopup final : public QFrame {
public:
    HealthPopup(model::SessionView& session, Commands& commands, const model::CharacterKey& key,
                QWidget* parent)
        : QFrame(parent, Qt::Popup), m_session(session), m_commands(commands), m_key(key) {
        setAttribute(Qt::WA_DeleteOnClose);
        setObjectName(QStringLiteral("healthPopup"));
        const int space = fontMetrics().height() * 3 / 4;
        auto* column = new QVBoxLayout(this);
        column->setContentsMargins(space, space, space, space);
        column->setSpacing(space / 2);
        addTitle(*column);
        addTroubles(*column);
        addButtons(*column);
        setFixedWidth(fontMetrics().averageCharWidth() * 64);
    }

protected:
    void paintEvent(QPaintEvent* /*event*/) override { paintFrame(*this); }

private:
    void addTitle(QVBoxLayout& column) {
        const model::TakeVerdict& verdict = m_session.verdicts().of(m_key);
        const Health health = healthOf(verdict.state);
        auto* title = plainLabel(nameApart(m_session.atNow(), m_key), this);
        title->setProperty("heading", true);
        auto* words = plainLabel(healthText(health, said(verdict.said, words::Form::Brief)), this);
        setTextColour(*words, healthColour(health));
        auto* row = new QHBoxLayout;
        row->addWidget(title, 1);
        row->addWidget(words);
        column.addLayout(row);
        auto* full = dimText(said(verdict.said, words::Form::Headline), this);
        full->setObjectName(QStringLiteral("verdict"));
        column.addWidget(full);
        column.addWidget(dimText(lossText(m_session, m_key), this));
    }

    void addTroubles(QVBoxLayout& column) {
        const auto troubles = m_session.verdicts().troublesOf(m_key);
        for (std::size_t i = 0; i < std::min(kMostLines, troubles.size()); ++i) {
            const model::Incident& event = *troubles[i];
            QString text = said(event.of(m_key).fact(), words::Form::Sentence);
            if (const auto type = event.type()) {
                text.prepend(tr("Type %1: ").arg(*type, 2, 10, QLatin1Char('0')));
            }
            auto* line =
                new TroubleLine(healthOf(event.severity()), text,
                                tr("since %1").arg(timeOfDay(m_session.wallOf(event.firstStamp))), this);
            line->setToolTip(toolTipText(tr("Show the packets")));
            connect(line, &QAbstractButton::clicked, this,
                    [this, number = event.number] { showPackets(number); });
            column.addWidget(line);
        }
        if (troubles.size() > kMostLines) {
            column.addWidget(dimText(tr("and %1 more").arg(grouped(troubles.size() - kMostLines)), this));
        }
    }

    void addButtons(QVBoxLayout& column) {
        auto* row = new QHBoxLayout;
        const auto add = [&](const QString& name, const QString& text, auto run) {
            auto* button = new QPushButton(text, this);
            button->setObjectName(name);
            button->setAutoDefault(true);
            connect(button, &QPushButton::clicked, this, [this, run] {
                run();
                close();
            });
            row->addWidget(button);
        };
        row->addStretch(1);
        add(QStringLiteral("frameCharacter"), tr("Show in the viewport"), [this] {
            m_commands.setCharacterVisible(m_key, true);
            m_commands.frameCharacter(m_key);
        });
        add(QStringLiteral("allEvents"), tr("Show incidents"),
            [this] { m_commands.showIncident(m_session.verdicts().of(m_key).incident, m_key); });
        if (const auto incident = m_session.verdicts().of(m_key).incident) {
            if (const model::Incident* found = m_session.verdicts().incidents().find(*incident)) {
                add(QStringLiteral("meaning"), tr("What it means"),
                    [place = helpPlaceOf(*found)] { openHelp(place); });
            }
        }
        column.addLayout(row);
    }

    void showPackets(std::uint64_t number) {
        const model::Incident* event = m_session.verdicts().incidents().find(number);
        if (event == nullptr || !gui::showPackets(m_session, m_commands, packetsBehind(m_session, *event),
                                                  PacketLook::InContext)) {
            m_commands.showDock(QStringLiteral("events"));
        }
        close();
    }

    model::SessionView& m_session;
    Commands& m_commands;
    model::CharacterKey m_key;
};

} // namespace

QString lossText(model::SessionView& session, const model::CharacterKey& key) {
    const model::TimeRange all{session.firstStamp(), session.cursorStamp() + log::Duration(1)};
    const model::StreamCounts counts = session.accounts().countsOf(key, boardSpan(session).value_or(all));
    const QString span = boardSpanText(session);
    if (counts.expected() == 0) {
        return tr("No samples · %1").arg(span);
    }
    const std::uint64_t lost = counts.lost + counts.incomplete;
    return lost == 0 ? tr("All %1 samples arrived · %2").arg(grouped(counts.expected()), span)
                     : tr("Lost %1 of %2 samples · %3").arg(grouped(lost), grouped(counts.expected()), span);
}

QWidget* showHealthPopup(model::SessionView& session, Commands& commands, const model::CharacterKey& key,
                         QWidget& anchor) {
    auto* popup = new HealthPopup(session, commands, key, &anchor);
    showAbove(*popup, anchor);
    if (const auto buttons = popup->findChildren<QAbstractButton*>(); !buttons.isEmpty()) {
        buttons.first()->setFocus(Qt::PopupFocusReason);
    }
    return popup;
}

HealthList::HealthList(model::SessionView& session, Commands& commands, QWidget* parent)
    : QFrame(parent, Qt::Popup), m_model(session, commands) {
    setAttribute(Qt::WA_DeleteOnClose);
    setObjectName(QStringLiteral("healthList"));
    m_model.setOrder(BoardOrder::TroubleFirst);
    m_model.refresh();
    m_table->setModel(&m_model);
    m_table->setHeaderHidden(true);
    m_table->columns().setChosen(
        {m_table->model()->headerData(CharacterModel::kVerdict, Qt::Horizontal).toString()});
    constexpr int kMostRows = 25;
    m_table->setFixedHeight(m_table->heightForRows(std::min(kMostRows, m_model.rowCount())));
    setFixedWidth(fontMetrics().averageCharWidth() * 64);
    auto* column = tightColumn(this);
    column->setContentsMargins(1, 1, 1, 1);
    column->addWidget(m_table);
    const auto choose = [this](const QModelIndex& index) {
        if (const auto key = m_model.character(index)) {
            emit chosen(*key);
            close();
        }
    };
    connect(m_table, &QAbstractItemView::clicked, this, choose);
    connect(m_table, &QAbstractItemView::activated, this, choose);
}

void HealthList::showAt(const QWidget& anchor) {
    showAbove(*this, anchor);
    m_table->setCurrentIndex(m_model.index(0, 0));
    m_table->setFocus(Qt::PopupFocusReason);
}

void HealthList::paintEvent(QPaintEvent* /*event*/) {
    paintFrame(*this);
}

} // namespace posewire::gui
