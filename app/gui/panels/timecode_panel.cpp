// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/timecode_panel.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/stream_state.h"
#include "app/gui/models/text.h"

#include <QButtonGroup>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QScreen>

namespace posewire::gui {

TimecodePanel::TimecodePanel(model::SessionView& view, Commands& commands, QWidget* parent)
    : Panel(parent),
      m_view(view),
      m_facts(clockFacts(m_clock)),
      m_large(new ClockWidget(this)),
      m_table(new TableView(tr("Clocks of the sender"), this)) {
    setBackgroundRole(QPalette::Base);
    setAutoFillBackground(true);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins({});
    layout->setSpacing(0);
    layout->addWidget(m_large, 1);
    const int space = fontMetrics().height() / 2;
    auto* choices = new QHBoxLayout;
    choices->setContentsMargins(space, 0, space, space / 2);
    choices->setSpacing(space / 2);
    auto* group = new QButtonGroup(this);
    choices->addStretch();
    for (QToolButton* button :
         {addChoice(tr("Header"), ClockChoice::Header), addChoice(tr("Type 25"), ClockChoice::Type25)}) {
        group->addButton(button);
        choices->addWidget(button);
    }
    choices->addStretch();
    layout->addLayout(choices);
    layout->addWidget(m_table);
    m_table->setModel(&m_facts);
    m_table->setHeaderHidden(true);
    m_table->setColumnSamples({QStringLiteral("Frame rate mm"), QString()});
    m_table->setFixedHeight(m_table->heightForRows(m_facts.rowCount()));
    m_table->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    connect(m_table, &TableView::copyRequested, this,
            [&commands](const QString& text) { commands.copyText(text); });
    connect(m_large, &ClockWidget::fullScreenToggled, this, [this] { setFullScreen(true); });
    showClock();
}

QToolButton* TimecodePanel::addChoice(const QString& text, ClockChoice choice) {
    auto* button = new QToolButton(this);
    button->setText(text);
    button->setCheckable(true);
    button->setChecked(choice == m_choice);
    button->setProperty("framed", true);
    button->setAccessibleName(tr("Large clock: %1").arg(text));
    connect(button, &QToolButton::clicked, this, [this, choice] {
        m_choice = choice;
        showClock();
    });
    return button;
}

void TimecodePanel::refresh() {
    m_clock.follow(m_view, shownCharacter(m_view));
    m_facts.refresh();
    showClock();
}

QString TimecodePanel::caption() const {
    const auto key = shownCharacter(m_view);
    if (!key) {
        return tr("No character on the air");
    }
    if (m_choice == ClockChoice::Type25 && !m_clock.type25()) {
        return tr("No type 25 on the air. In MVN: Network Streamer > Time Code");
    }
    if (m_clock.headerMs() && age() >= kStaleAge) {
        return tr("stale %1").arg(duration(age()));
    }
    return characterName(m_view, *key);
}

double TimecodePanel::age() const {
    return log::secondsOf(m_view.cursorStamp() - m_clock.lastStamp());
}

void TimecodePanel::showClock() {
    const QString text = clockText(m_clock, m_choice);
    const bool hasTime =
        m_choice == ClockChoice::Header ? m_clock.headerMs().has_value() : m_clock.type25().has_value();
    const ClockWidget::Run run = !hasTime             ? ClockWidget::Run::None
                                 : age() >= kStaleAge ? ClockWidget::Run::Stale
                                                      : ClockWidget::Run::Running;
    m_large->setClock(text, caption(), run);
    if (m_fullScreen) {
        m_fullScreen->setClock(text, caption(), run);
    }
}

QString TimecodePanel::summary() const {
    return m_choice == ClockChoice::Header ? tr("header · ms") : tr("type 25");
}

void TimecodePanel::setFullScreen(bool isFullScreen) {
    if (!isFullScreen) {
        if (m_fullScreen) {
            m_fullScreen->hide();
            m_fullScreen.release()->deleteLater(); // it may be what is calling
        }
        return;
    }
    m_fullScreen = std::make_unique<ClockWidget>();
    m_fullScreen->setWindowTitle(tr("Time code"));
    m_fullScreen->setToolTip({});
    m_fullScreen->setAttribute(Qt::WA_QuitOnClose, false);
    m_fullScreen->setGeometry(screen()->geometry());
    connect(m_fullScreen.get(), &ClockWidget::left, this, [this] { setFullScreen(false); });
    connect(m_fullScreen.get(), &ClockWidget::fullScreenToggled, this, [this] { setFullScreen(false); });
    showClock();
    m_fullScreen->showFullScreen();
    m_fullScreen->setFocus();
}

} // namespace posewire::gui
