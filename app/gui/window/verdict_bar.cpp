// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/verdict_bar.h"

#include "app/gui/models/character_model.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/event_watch.h"
#include "core/model/session/roster.h"

#include <QAccessible>
#include <QAction>
#include <QPainter>
#include <QToolButton>

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr double kLarge = 2.6; // against the desktop's font

QToolButton* buttonFor(QAction* action, const QString& text, QWidget* parent) {
    QToolButton* button = framedButton(text, action->toolTip(), parent);
    button->setObjectName(action->objectName() + QStringLiteral("Button"));
    QObject::connect(button, &QToolButton::clicked, action, &QAction::trigger);
    return button;
}

/// "2 good", "1 of 3 good": what waits behind a file.
QString liveText(const model::SessionView& live, const model::TakeVerdict& verdict) {
    if (verdict.state == model::TakeVerdict::State::None) {
        return VerdictBar::tr("no data yet");
    }
    const auto characters = live.atNow().roster().listed();
    const auto good = std::ranges::count_if(characters, [&](const model::Character* character) {
        return live.verdicts().of(character->key).state == model::TakeVerdict::State::Good;
    });
    return static_cast<std::size_t>(good) == characters.size()
               ? VerdictBar::tr("%1 good").arg(good)
               : VerdictBar::tr("%1 of %2 good").arg(good).arg(characters.size());
}

QString spanOf(const model::SessionView& live) {
    if (live.choices().reset == log::Stamp()) {
        return boardSpanText(live);
    }
    const bool isAll = live.now() - live.choices().reset < model::VerdictSpan::kRecent;
    return (isAll ? VerdictBar::tr("now, since the reset at %1")
                  : VerdictBar::tr("now, last 10 s · reset at %1"))
        .arg(timeOfDay(live.wallOf(live.choices().reset)).chopped(4));
}

} // namespace

Headline::Headline(QWidget* parent) : QAbstractButton(parent) {
    setObjectName(QStringLiteral("headline"));
    setFocusPolicy(Qt::TabFocus);
    setCursor(Qt::PointingHandCursor);
    setAttribute(Qt::WA_Hover);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setToolTip(toolTipText(tr("Click for the evidence")));
}

void Headline::setVerdict(const model::TakeVerdict& verdict, const QString& context) {
    const QString text = context + said(verdict.said, words::Form::Headline);
    const bool isTurn = !sayTheSame(verdict, m_verdict);
    m_verdict = verdict;
    if (!isTurn && text == this->text()) {
        return;
    }
    m_level = healthOf(verdict.state);
    m_narrow = context + said(verdict.said, words::Form::Narrow);
    setText(text);
    setAccessibleName(text);
    if (isTurn) {
        QAccessibleEvent spoken(this, QAccessible::Alert);
        QAccessible::updateAccessibility(&spoken);
    }
    update();
}

void Headline::setLarge(bool isLarge) {
    if (m_isLarge != isLarge) {
        m_isLarge = isLarge;
        updateGeometry();
        update();
    }
}

QFont Headline::fontFor(int width, bool& fits) const {
    constexpr double kHinting = 0.96; // letters do not grow in step with their size
    QFont font = this->font();
    font.setWeight(QFont::DemiBold);
    const double times =
        (width - fontMetrics().height()) / std::max(1.0, QFontMetricsF(font).horizontalAdvance(line()));
    fits = times >= 1;
    if (m_isLarge) {
        font.setPointSizeF(font.pointSizeF() * std::clamp(kHinting * times, 1.0, kLarge));
    }
    return font;
}

QSize Headline::sizeHint() const {
    QFont font = this->font();
    font.setWeight(QFont::DemiBold);
    font.setPointSizeF(font.pointSizeF() * (m_isLarge ? kLarge : 1.0));
    const QFontMetrics metrics(font);
    return {metrics.horizontalAdvance(line()) + fontMetrics().height(),
            metrics.height() + fontMetrics().height() / (m_isLarge ? 1 : 2)};
}

QSize Headline::minimumSizeHint() const {
    return {fontMetrics().averageCharWidth() * 20, sizeHint().height()};
}

void Headline::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const bool isColoured = m_level != Health::Unknown;
    painter.setPen(hasFocus() ? QPen(theme().accent, 2) : Qt::NoPen);
    painter.setBrush(isColoured     ? tinted(healthColour(m_level))
                     : underMouse() ? theme().raised
                                    : theme().panel);
    painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), 4, 4);
    bool fits = true;
    painter.setFont(fontFor(width(), fits));
    QRect room = rect().adjusted(fontMetrics().height() / 2, 0, -fontMetrics().height() / 2, 0);
    if (isColoured) {
        painter.setPen(healthColour(m_level));
        painter.drawText(room, Qt::AlignVCenter | Qt::AlignLeft, healthSymbol(m_level));
        room.setLeft(room.left() + painter.fontMetrics().horizontalAdvance(healthText(m_level, {})));
    }
    painter.setPen(isColoured ? theme().text : theme().dim);
    painter.drawText(room, Qt::AlignVCenter | Qt::AlignLeft,
                     fits ? text()
                          : painter.fontMetrics().elidedText(m_narrow, Qt::ElideRight, room.width()));
}

VerdictBar::VerdictBar(model::SessionView& live, const Actions& actions, QWidget* parent)
    : QWidget(parent),
      m_live(live),
      m_reset(buttonFor(actions.reset, tr("Reset before take"), this)),
      m_showFile(buttonFor(actions.showFile, {}, this)),
      m_goLive(buttonFor(actions.live, {}, m_strip)),
      m_closeFile(buttonFor(actions.closeFile, tr("Close recording"), m_strip)),
      m_endComparison(buttonFor(actions.endComparison, tr("End comparison"), m_strip)),
      m_recovered(buttonFor(actions.recovered, tr("Recovered packets…"), m_strip)) {
    setObjectName(QStringLiteral("verdictBar"));
    m_span->setObjectName(QStringLiteral("verdictSpan"));
    m_span->setFont(tabularFont());
    m_strip->setObjectName(QStringLiteral("strip"));
    m_what->setObjectName(QStringLiteral("stripText"));
    m_what->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
    auto* row = spacedRow({12, 4, 12, 4}, 10);
    row->addWidget(m_headline, 1);
    row->addWidget(m_span);
    row->addWidget(m_reset);
    row->addWidget(m_showFile);
    auto* strip = spacedRow({12, 3, 12, 3}, 10, m_strip);
    strip->addWidget(m_what, 1);
    strip->addWidget(m_recovered);
    strip->addWidget(m_later);
    strip->addWidget(m_endComparison);
    strip->addWidget(m_goLive);
    strip->addWidget(m_closeFile);
    auto* column = tightColumn(this);
    column->addLayout(row);
    column->addWidget(m_strip);
    m_strip->hide();
    paintAsBar(this);
    new EventWatch(m_strip, QEvent::Paint, [this] {
        QPainter painter(m_strip);
        painter.fillRect(m_strip->rect(), tinted(theme().accent));
        painter.fillRect(QRect(0, 0, 4, m_strip->height()), theme().accent);
    });
    const auto dismiss = [this] {
        m_recovery.clear();
        emit recoveryDismissed();
    };
    connect(actions.recovered, &QAction::triggered, this, dismiss);
    connect(m_later, &QToolButton::clicked, this, dismiss);
    connect(m_headline, &QAbstractButton::clicked, this, &VerdictBar::showEvidence);
}

void VerdictBar::setLarge(bool isLarge) {
    m_isLarge = isLarge;
    m_headline->setLarge(isLarge);
}

void VerdictBar::showRecovery(const QString& text) {
    m_recovery = text;
}

void VerdictBar::refresh(const ShownFile& file, bool hasInputs, const QString& blocked) {
    m_verdict = m_live.verdicts().all().all;
    m_isOfFile = file.isShown && m_verdict.state == model::TakeVerdict::State::None && blocked.isEmpty();
    showVerdict(file, blocked);
    showStrip(file, hasInputs);
    const bool isOfLive = !m_isOfFile && (hasInputs || file.name.isEmpty());
    m_headline->setVisible(m_isOfFile || isOfLive);
    m_span->setVisible(isOfLive);
    m_reset->setVisible(isOfLive);
}

void VerdictBar::showVerdict(const ShownFile& file, const QString& blocked) {
    model::TakeVerdict shown = m_isOfFile ? file.verdict : m_verdict;
    if (!m_isOfFile && shown.state == model::TakeVerdict::State::None && !blocked.isEmpty()) {
        shown.state = model::TakeVerdict::State::Bad;
        shown.said = {words::Kind::Text, {{"text", blocked.toStdString()}}};
    }
    const bool isBehindFile = file.isShown && !m_isOfFile;
    m_headline->setLarge(m_isLarge && !isBehindFile);
    m_headline->setVerdict(shown, isBehindFile ? tr("Live: ") : QString());
    m_span->setText(spanOf(m_live));
    m_reset->setEnabled(m_live.end() != 0);
}

void VerdictBar::showStrip(const ShownFile& file, bool hasInputs) {
    const QString compared = file.comparison.isEmpty() ? QString() : QLatin1Char(' ') + file.comparison;
    const bool isRecovery = !file.isShown && compared.isEmpty() && !m_recovery.isEmpty();
    m_strip->setVisible(file.isShown || isRecovery || !compared.isEmpty());
    m_recovered->setVisible(isRecovery);
    m_later->setVisible(isRecovery);
    m_showFile->setVisible(!file.isShown && !file.name.isEmpty());
    m_showFile->setText(tr("Show %1").arg(
        fontMetrics().elidedText(file.name, Qt::ElideMiddle, fontMetrics().averageCharWidth() * 24)));
    if (file.isShown) {
        QStringList lines = file.notes;
        if (!m_isOfFile) {
            lines.prepend(said(file.verdict.said, words::Form::Headline));
        }
        lines.removeAll(QString());
        m_what->setText(tr("Recording %1").arg(file.name) + compared,
                        (lines.isEmpty() ? QString() : QStringLiteral(" · ")) +
                            lines.join(QStringLiteral(" · ")));
    } else {
        m_what->setText(isRecovery ? m_recovery : tr("What is received,") + compared);
    }
    m_endComparison->setVisible(!compared.isEmpty());
    m_what->setToolTip(toolTipText(m_what->text()));
    m_what->setAccessibleName(m_what->text());
    m_goLive->setVisible(file.isShown && hasInputs);
    m_goLive->setText(tr("Back to live (%1)").arg(liveText(m_live, m_verdict)));
    m_closeFile->setVisible(file.isShown);
}

} // namespace posewire::gui
