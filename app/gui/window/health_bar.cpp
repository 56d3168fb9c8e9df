// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/health_bar.h"

#include "app/gui/models/character_model.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/words.h"
#include "app/gui/window/health_popup.h"
#include "core/model/session/verdict.h"

#include <QToolButton>

#include <algorithm>
#include <optional>
#include <span>

namespace posewire::gui {

namespace {

constexpr int kMessageMs = 12'000;
/// More do not fit into any window.
constexpr std::size_t kMostEntries = 24;

/// From the first packet that can still be looked at to the newest.
std::optional<double> historySeconds(model::SessionView& session) {
    const auto first = session.end() != 0 ? session.packet(session.begin()) : std::nullopt;
    const auto last = first ? session.packet(session.end() - 1) : std::nullopt;
    return last ? std::optional(std::max(0.0, log::secondsOf(last->stamp - first->stamp))) : std::nullopt;
}

QString historyText(model::SessionView& session) {
    const log::LogFigures figures = session.log().figures();
    QString text =
        HealthBar::tr("%1 of %2 MB").arg(inMegabytes(figures.memoryInUse), inMegabytes(figures.memoryCap));
    if (const auto seconds = historySeconds(session)) {
        text.prepend(duration(*seconds) + QStringLiteral(" · "));
    }
    return HealthBar::tr("history %1").arg(text);
}

/// Without whose loss it is.
QString whatOf(const model::TakeVerdict& verdict) {
    return said(verdict.said, words::Form::Cell);
}

/// Numbers grow and shrink; their neighbours stay.
void showFigure(QLabel& label, Health level, const QString& text) {
    setTextColour(label, healthColour(level));
    label.setText(level == Health::Unknown ? text : healthText(level, text));
    label.setAccessibleName(text);
    label.setMinimumWidth(std::max(label.minimumWidth(), label.sizeHint().width()));
}

QString leftOut(std::size_t all, std::size_t fitting) {
    return fitting != 0 ? HealthBar::tr("+ %1 more").arg(grouped(all - fitting))
                        : HealthBar::tr("%1 characters", nullptr, static_cast<int>(all)).arg(grouped(all));
}

} // namespace

HealthBar::HealthBar(model::SessionView& session, Commands& commands, QWidget* parent)
    : QWidget(parent),
      m_session(&session),
      m_commands(commands),
      m_more(new ColourText(ColourText::Look::Plain, m_entriesArea)),
      m_message(new PassingMessage(kMessageMs, this)),
      m_about(flatButton(QStringLiteral("?"), tr("Help on this message"), this)),
      m_waysOut(new ColourText(ColourText::Look::Plain, this)) {
    setObjectName(QStringLiteral("healthBar"));
    auto* row = spacedRow({6, 1, 6, 1}, 8, this);
    // More characters than there is room for must not widen the window.
    m_entriesArea->setLayout(m_entriesLayout);
    m_entriesArea->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    m_entriesLayout->setContentsMargins(0, 0, 0, 0);
    m_entriesLayout->setSpacing(2);
    m_entriesLayout->setSizeConstraint(QLayout::SetNoConstraint);
    m_entriesLayout->addWidget(m_more);
    m_entriesLayout->addStretch(1);
    m_more->setObjectName(QStringLiteral("more"));
    m_more->setToolTip(
        toolTipText(tr("More characters than fit here. Click for a list of all, the worst first.")));
    connect(m_more, &ColourText::clicked, this, &HealthBar::showList);
    m_when->setContentsMargins(6, 0, 0, 0);
    row->addWidget(m_when);
    row->addWidget(m_entriesArea, 1);
    row->addWidget(m_about);
    row->addWidget(m_message, 1);
    m_about->setObjectName(QStringLiteral("messageHelp"));
    m_about->setFocusPolicy(Qt::TabFocus);
    m_about->hide();
    connect(m_about, &QToolButton::clicked, this, [this] { openHelp(m_helpPlace); });
    new EventWatch(m_message, QEvent::Hide, [this] { m_about->hide(); });
    m_message->setObjectName(QStringLiteral("message"));
    m_live->setObjectName(QStringLiteral("ofNow"));
    m_waysOut->setObjectName(QStringLiteral("waysOut"));
    m_waysOut->hide();
    row->addWidget(m_waysOut);
    connect(m_waysOut, &ColourText::clicked, this, &HealthBar::waysOutRequested);
    for (QLabel* figure : {m_history, m_live, m_rate, m_dropped}) {
        figure->setFont(tabularFont());
        const int margin = ColourText::marginsOf(figure->fontMetrics()) / 2; // as the buttons beside them
        figure->setContentsMargins(margin, 0, margin, 0);
        row->addWidget(figure);
    }
    m_dropped->setToolTip(
        tr("Datagrams that reached this computer and were dropped because its receive buffer was full."));
    m_history->setToolTip(
        tr("How far back packets can be looked at, in memory or on disk, and how much memory they use."));
}

void HealthBar::say(const QString& text, const QString& helpPlace) {
    m_helpPlace = helpPlace;
    m_message->say(text);
    m_about->setVisible(!text.isEmpty() && !helpPlace.isEmpty());
}

void HealthBar::showSession(model::SessionView& session) {
    delete m_list;
    delete m_popup;
    m_session = &session;
    m_nameWidth = m_stateWidth = 0;
    for (QLabel* figure : {m_rate, m_history, m_dropped}) {
        figure->setMinimumWidth(0);
    }
    refreshCharacters();
}

QString HealthBar::byteRateText(double bytesPerSecond) {
    constexpr double kLeastMegabytes = 0.1;
    const double megabytes = bytesPerSecond / 1e6;
    return megabytes >= kLeastMegabytes || megabytes == 0 ? tr("%1 MB/s").arg(fixed(megabytes, 2))
                                                          : tr("%1 kB/s").arg(fixed(1e3 * megabytes, 1));
}

void HealthBar::refresh(const ReceivingState& receiving) {
    refreshCharacters();
    showWaysOut(receiving.waysOut);
    showFigure(*m_rate, Health::Unknown,
               tr("%1 datagrams/s · %2")
                   .arg(grouped(static_cast<std::uint64_t>(receiving.datagramsPerSecond)),
                        byteRateText(receiving.bytesPerSecond)));
    showFigure(*m_history, Health::Unknown, historyText(*m_session));
    const bool isQuiet = m_session->isRecording() || m_session->end() == 0;
    const Health untroubled = isQuiet || !net::kCountsDrops ? Health::Unknown : Health::Good;
    showFigure(*m_dropped, receiving.kernelDropped == 0 ? untroubled : Health::Error,
               net::kCountsDrops ? tr("dropped here %1 in all").arg(grouped(receiving.kernelDropped))
                                 : tr("dropped here: not known"));
}

void HealthBar::showWaysOut(const std::vector<WayOutState>& ways) {
    QStringList lines;
    Health level = Health::Good;
    for (const WayOutState& way : ways) {
        if (way.target.isOn) {
            const PropertyValue stage = wayOutStage(way);
            const bool isWorse = stage.health == Health::Error || level == Health::Good;
            level = stage.health != Health::Good && isWorse ? stage.health : level;
            lines +=
                tr("%1 to %2: %3, %4 sent")
                    .arg(translatedText(way.form), displayText(way.target), stage.text, grouped(way.sent));
        }
    }
    m_waysOut->setVisible(!lines.isEmpty());
    if (lines.isEmpty()) {
        return;
    }
    m_waysOut->setContent(level, tr("⇉ %n ways out", nullptr, static_cast<int>(lines.size())));
    m_waysOut->setToolTip(toolTipText(lines.join(QLatin1Char('\n'))));
}

void HealthBar::refreshCharacters() {
    m_shown = boardOf(*m_session, BoardOrder::TroubleFirst);
    m_when->setText(m_session->isRecording() ? tr("Recording") : tr("Now"));
    m_live->setVisible(m_session->isRecording());
    const bool isForMessage = m_shown.empty() && m_message->isVisible();
    qobject_cast<QHBoxLayout*>(layout())->setStretchFactor(m_entriesArea, isForMessage ? 0 : 1);
    while (m_entries.size() < std::min(m_shown.size(), kMostEntries)) {
        auto* entry = new ColourText(ColourText::Look::Plain, this);
        const std::size_t index = m_entries.size();
        connect(entry, &ColourText::clicked, this, [this, index, entry] { explain(m_shown[index], *entry); });
        m_entriesLayout->insertWidget(static_cast<int>(index), entry);
        m_entries.push_back(entry);
    }
    fitEntries();
    if (m_list != nullptr) {
        m_list->refresh();
    }
}

/// As wide as the longest of each that was said so far, up to what is usual: they only grow, so that nothing
/// moves to and fro.
void HealthBar::measure(const QFontMetrics& metrics) {
    const auto widthOf = [&metrics](const QString& text) { // not rounded down
        return metrics.horizontalAdvance(text) + 1;
    };
    const auto grow = [&widthOf](int& width, const QString& text, const QString& most) {
        width = std::clamp(widthOf(text), width, std::max(width, widthOf(most)));
    };
    grow(m_stateWidth, tr("10.0 % lost"), tr("10.0 % lost, over"));
    for (const model::CharacterKey& key : std::span(m_shown).first(std::min(m_shown.size(), kMostEntries))) {
        grow(m_stateWidth, whatOf(m_session->verdicts().of(key)), tr("10.0 % lost, over"));
        grow(m_nameWidth, nameApart(m_session->atNow(), key), QStringLiteral("Performer with a name"));
    }
}

/// Shows as many entries as have room, and says how many have none. All are of one width, whatever they say,
/// so that no word moves its neighbour; names have what is left of the room.
void HealthBar::fitEntries() {
    const QFontMetrics metrics = m_more->fontMetrics();
    measure(metrics);
    const int spacing = m_entriesLayout->spacing();
    const int beside = metrics.horizontalAdvance(QStringLiteral("■   ")) + ColourText::marginsOf(metrics);
    const int leastName = std::min(m_nameWidth, metrics.horizontalAdvance(QStringLiteral("Performer 1")));
    const int room = m_entriesArea->width() + spacing;
    const int reserve = metrics.horizontalAdvance(QStringLiteral("■ + 00 more")) + 2 * spacing;
    const auto all = m_shown.size();
    const auto most = std::min(all, kMostEntries);
    const int least = beside + leastName + m_stateWidth + spacing;
    const auto fitting = static_cast<int>(all) * least <= room
                             ? most
                             : std::min<std::size_t>(most, std::max(0, (room - reserve) / least));
    const int left = fitting == all ? room : room - reserve;
    const int spare = left / std::max(1, static_cast<int>(fitting)) - least;
    const int nameWidth = std::clamp(leastName + spare, leastName, std::max(leastName, m_nameWidth));
    for (std::size_t i = 0; i < m_entries.size(); ++i) {
        m_entries[i]->setVisible(i < fitting);
        if (i < fitting) {
            showEntry(i, nameWidth, beside + nameWidth + m_stateWidth);
        }
    }
    m_more->setVisible(fitting < all);
    // The first that has no room is the worst of them.
    const Health worst =
        fitting < all ? healthOf(m_session->verdicts().of(m_shown[fitting]).state) : Health::Unknown;
    m_more->setContent(worst == Health::Good ? Health::Unknown : worst, leftOut(all, fitting));
}

void HealthBar::showEntry(std::size_t index, int nameWidth, int width) {
    const model::TakeVerdict& verdict = m_session->verdicts().of(m_shown[index]);
    const PropertyValue state = verdictState(verdict);
    ColourText* entry = m_entries[index];
    const QFontMetrics metrics = entry->fontMetrics();
    const QString what = whatOf(verdict);
    const int room = std::max(nameWidth, nameWidth + m_stateWidth - metrics.horizontalAdvance(what));
    entry->setFixedWidth(width);
    entry->setContent(state.health, metrics.elidedText(nameApart(m_session->atNow(), m_shown[index]),
                                                       Qt::ElideRight, room) +
                                        QLatin1Char(' ') + what);
    entry->setToolTip(toolTipText(state.toolTip));
}

QWidget* HealthBar::firstEntry() const {
    if (m_shown.empty()) {
        return nullptr;
    }
    return m_entries.front()->isHidden() ? m_more : m_entries.front();
}

void HealthBar::explain(const model::CharacterKey& key, QWidget& anchor) {
    m_commands.select({key.sender, key, -1});
    m_popup = showHealthPopup(*m_session, m_commands, key, anchor);
}

void HealthBar::showList() {
    m_list = new HealthList(*m_session, m_commands, this);
    connect(m_list, &HealthList::chosen, this,
            [this](const model::CharacterKey& key) { explain(key, *m_more); });
    m_list->showAt(*m_more);
}

} // namespace posewire::gui
