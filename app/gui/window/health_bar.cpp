// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/health_bar.h"

#include "app/gui/models/incident_words.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/theme/words.h"
#include "app/gui/viewport/captions.h"
#include "app/gui/window/colour_text.h"

#include <QAbstractButton>
#include <QFrame>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QScreen>
#include <QVBoxLayout>

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr int kMessageMs = 12'000;

/// From the first packet to the newest.
double historySeconds(model::SessionView& session) {
    const log::Stamp first = session.firstStamp(); // its stream may be gone
    log::Stamp last = first;
    for (const model::Stream& stream : session.streams()) {
        last = std::max(last, stream.accounting.lastStamp());
    }
    return log::secondsOf(last - first);
}

QString historyText(model::SessionView& session) {
    const log::LogFigures figures = session.figures();
    QString text = HealthBar::tr("%1 of %2")
                       .arg(megabytes(figures.memoryInUse).section(QLatin1Char(' '), 0, 0),
                            megabytes(figures.memoryCap));
    // What the cap has pushed out is no longer history: only while all is kept does the first packet date it.
    if (figures.begin == 0 && figures.end != 0) {
        text.prepend(duration(historySeconds(session)) + QStringLiteral(" · "));
    }
    return HealthBar::tr("history %1").arg(text);
}

constexpr log::Duration kPast = std::chrono::seconds(10);
/// More would be a list: that is in the dock of incidents.
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

    void keyPressEvent(QKeyEvent* event) override {
        if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) {
            click();
            return;
        }
        QAbstractButton::keyPressEvent(event);
    }

private:
    [[nodiscard]] int margin() const { return fontMetrics().height() / 3; }
    [[nodiscard]] int markWidth() const {
        return fontMetrics().horizontalAdvance(healthSymbol(m_level) + QStringLiteral("  "));
    }

    Health m_level;
    QString m_note;
};

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

    /// Over a widget at the bottom of the window.
    void showAbove(const QWidget& widget) {
        adjustSize();
        const QRect room = widget.screen()->availableGeometry();
        QPoint place = widget.mapToGlobal(QPoint(0, -height() - 4));
        place.setX(std::clamp(place.x(), room.left(), std::max(room.left(), room.right() - width())));
        place.setY(std::max(place.y(), room.top()));
        move(place);
        show();
        const auto buttons = findChildren<QAbstractButton*>();
        if (!buttons.isEmpty()) {
            buttons.first()->setFocus(Qt::PopupFocusReason);
        }
    }

protected:
    void paintEvent(QPaintEvent* /*event*/) override {
        QPainter painter(this);
        painter.setPen(theme().line);
        painter.setBrush(theme().panel);
        painter.drawRect(rect().adjusted(0, 0, -1, -1));
    }

private:
    void addTitle(QVBoxLayout& column) {
        const PropertyValue state = characterHealth(m_session, m_key);
        auto* title = plainLabel(shown(m_session.displayName(m_key)), this);
        QFont bold = title->font();
        bold.setWeight(QFont::DemiBold);
        title->setFont(bold);
        auto* words = plainLabel(healthText(state.health, state.text), this);
        setTextColour(*words, healthColour(state.health));
        auto* row = new QHBoxLayout;
        row->addWidget(title, 1);
        row->addWidget(words);
        column.addLayout(row);
        column.addWidget(dimText(lossText(m_session, m_key), this));
    }

    void addTroubles(QVBoxLayout& column) {
        const auto troubles = m_session.troublesOf(m_key);
        for (std::size_t i = 0; i < std::min(kMostLines, troubles.size()); ++i) {
            const model::Incident& event = *troubles[i];
            QString text = QString::fromStdString(event.of(m_key.character).text());
            if (const auto type = event.type()) {
                text.prepend(tr("Type %1: ").arg(*type, 2, 10, QLatin1Char('0')));
            }
            auto* line =
                new TroubleLine(healthOf(event.severity()), text,
                                tr("since %1").arg(timeOfDay(m_session.wallOf(event.firstStamp))), this);
            line->setToolTip(tr("Show the packets"));
            connect(line, &QAbstractButton::clicked, this,
                    [this, number = event.number] { showPackets(number); });
            column.addWidget(line);
        }
        if (troubles.size() > kMostLines) {
            column.addWidget(dimText(tr("and %1 more").arg(grouped(troubles.size() - kMostLines)), this));
        }
        const model::Condition condition = m_session.conditionOf(m_key);
        if (troubles.empty()) {
            column.addWidget(dimText(condition.reason.empty() ? tr("Nothing is wrong.")
                                                              : QString::fromStdString(condition.reason),
                                     this));
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
        add(QStringLiteral("allEvents"), tr("All incidents"),
            [this] { m_commands.showDock(QStringLiteral("events")); });
        column.addLayout(row);
    }

    void showPackets(std::uint64_t number) {
        const model::Incident* event = m_session.incidents().find(number);
        if (event == nullptr || !showPacketsOf(m_session, m_commands, *event)) {
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
    const log::Stamp now = session.cursorStamp();
    const model::StreamCounts counts = session.countsOf(key, {now - kPast, now});
    if (counts.expected() == 0) {
        return tr("No samples in the last 10 s.");
    }
    const std::uint64_t lost = counts.lost + counts.incomplete;
    return lost == 0
               ? tr("All %1 samples of the last 10 s arrived.").arg(grouped(counts.expected()))
               : tr("Lost %1 of %2 samples in the last 10 s.").arg(grouped(lost), grouped(counts.expected()));
}

HealthBar::HealthBar(model::SessionView& session, Commands& commands, QWidget* parent)
    : QWidget(parent),
      m_session(session),
      m_commands(commands),
      m_entriesLayout(new QHBoxLayout),
      m_entriesArea(new QWidget(this)),
      m_more(new ColourText(ColourText::Look::Plain, m_entriesArea)),
      m_message(new PassingMessage(kMessageMs, this)),
      m_rate(new ColourText(ColourText::Look::Plain, this)),
      m_history(new ColourText(ColourText::Look::Plain, this)),
      m_dropped(new ColourText(ColourText::Look::Plain, this)) {
    setObjectName(QStringLiteral("healthBar"));
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(6, 1, 6, 1);
    row->setSpacing(8);
    // More characters than there is room for must not widen the window.
    m_entriesArea->setLayout(m_entriesLayout);
    m_entriesArea->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    m_entriesLayout->setContentsMargins(0, 0, 0, 0);
    m_entriesLayout->setSpacing(2);
    m_entriesLayout->setSizeConstraint(QLayout::SetNoConstraint);
    m_entriesLayout->addWidget(m_more);
    m_entriesLayout->addStretch(1);
    m_more->setToolTip(tr("More characters than fit here; the Characters dock lists them all."));
    row->addWidget(m_entriesArea, 1);
    row->addWidget(m_message, 1);
    m_message->setObjectName(QStringLiteral("message"));
    m_message->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    for (ColourText* text : {m_rate, m_history, m_dropped}) {
        row->addWidget(text);
    }
    m_dropped->setToolTip(
        tr("Datagrams that reached this computer and were dropped because its receive buffer was full."));
    m_history->setToolTip(tr("How far back the packets in memory go, and how much memory they may use."));
}

void HealthBar::refresh(const ReceivingState& receiving) {
    refreshCharacters();
    m_rate->setContent(Health::Unknown,
                       tr("%1 datagrams/s · %2")
                           .arg(grouped(static_cast<std::uint64_t>(receiving.datagramsPerSecond)),
                                tr("%1 MB/s").arg(fixed(receiving.bytesPerSecond / 1e6, 2))));
    m_history->setContent(Health::Unknown, historyText(m_session));
    m_dropped->setContent(receiving.kernelDropped == 0 ? Health::Good : Health::Error,
                          tr("dropped here %1").arg(grouped(receiving.kernelDropped)));
}

void HealthBar::refreshCharacters() {
    m_shown.clear();
    for (const model::Character* character : m_session.currentCharacters()) {
        m_shown.push_back(character->key);
    }
    while (m_entries.size() < m_shown.size()) {
        addEntry();
    }
    for (std::size_t i = 0; i < m_shown.size(); ++i) {
        const PropertyValue state = characterHealth(m_session, m_shown[i]);
        const QString words = state.health == Health::Good ? tr("good") : state.text;
        m_entries[i]->setContent(state.health,
                                 shown(m_session.displayName(m_shown[i])) + QLatin1Char(' ') + words);
    }
    fitEntries();
}

/// Shows as many entries as have room, and says how many have none.
void HealthBar::fitEntries() {
    const int spacing = m_entriesLayout->spacing();
    const int reserve = m_more->fontMetrics().horizontalAdvance(QStringLiteral("+ 0 000 more")) + 2 * spacing;
    int used = 0;
    std::size_t fitting = 0;
    for (; fitting < m_shown.size(); ++fitting) {
        const bool isLast = fitting + 1 == m_shown.size();
        used += m_entries[fitting]->sizeHint().width() + spacing;
        if (fitting != 0 && used + (isLast ? 0 : reserve) > m_entriesArea->width()) {
            break;
        }
    }
    for (std::size_t i = 0; i < m_entries.size(); ++i) {
        m_entries[i]->setVisible(i < fitting);
    }
    m_more->setVisible(fitting < m_shown.size());
    m_more->setContent(Health::Unknown, tr("+ %1 more").arg(grouped(m_shown.size() - fitting)));
}

void HealthBar::addEntry() {
    auto* entry = new ColourText(ColourText::Look::Plain, this);
    entry->setClickable(true);
    entry->setToolTip(tr("Select this character and show how it is doing"));
    const std::size_t index = m_entries.size();
    connect(entry, &ColourText::clicked, this, [this, index] { explain(index); });
    m_entriesLayout->insertWidget(static_cast<int>(index), entry);
    m_entries.push_back(entry);
}

QWidget* HealthBar::firstEntry() const {
    return m_shown.empty() ? nullptr : m_entries.front();
}

void HealthBar::explain(std::size_t entry) {
    const model::CharacterKey key = m_shown[entry];
    m_commands.select({key.sender, key, -1});
    auto* popup = new HealthPopup(m_session, m_commands, key, this);
    popup->showAbove(*m_entries[entry]);
}

} // namespace posewire::gui
