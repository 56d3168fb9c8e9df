// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/health_bar.h"

#include "app/gui/models/text.h"
#include "app/gui/viewport/character_health.h"
#include "app/gui/window/colour_text.h"
#include "app/gui/window/health_popup.h"

#include <QHBoxLayout>

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr int kMessageMs = 12'000;

QString perSecondText(double bytesPerSecond) {
    return HealthBar::tr("%1 MB/s").arg(fixed(bytesPerSecond / 1e6, 2));
}

/// From the first packet to the newest.
double historySeconds(model::SessionView& session) {
    log::Stamp first = log::Stamp::max();
    log::Stamp last{};
    for (const model::Stream& stream : session.streams()) {
        first = std::min(first, stream.accounting.firstStamp());
        last = std::max(last, stream.accounting.lastStamp());
    }
    return last <= first ? 0.0 : log::secondsOf(last - first);
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

} // namespace

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
                                perSecondText(receiving.bytesPerSecond)));
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
        const CharacterHealth health = characterHealth(m_session, m_shown[i]);
        const QString words = health.level == Health::Good ? tr("good") : health.words;
        m_entries[i]->setContent(health.level, QString::fromStdString(m_session.displayName(m_shown[i])) +
                                                   QLatin1Char(' ') + words);
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
