// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/timecode_panel.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/theme.h"

#include <QButtonGroup>
#include <QKeyEvent>
#include <QPainter>
#include <QScreen>

#include <algorithm>
#include <cmath>

namespace posewire::gui {

namespace {

constexpr double kMostInDock = 3.6;   ///< against the desktop's font: the verdict comes first
constexpr double kMostOfHeight = 0.4; ///< but in a tall dock

/// Pixel size at which `text` fits into `size`.
int fittingPixelSize(QFont font, const QString& text, const QSizeF& size) {
    constexpr int kProbe = 100;
    font.setPixelSize(kProbe);
    const QFontMetricsF metrics(font);
    const double byWidth = kProbe * size.width() / std::max(1.0, metrics.horizontalAdvance(text));
    const double byHeight = kProbe * size.height() / metrics.height();
    return std::max(8, static_cast<int>(std::floor(std::min(byWidth, byHeight))));
}

} // namespace

ClockWidget::ClockWidget(QWidget* parent) : QWidget(parent) {
    setAccessibleName(tr("Time code"));
    setFocusPolicy(Qt::StrongFocus);
    setToolTip(tr("Double-click or press F for full screen"));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void ClockWidget::setClock(const QString& text, const QString& caption, Run run) {
    if (text == m_text && caption == m_caption && run == m_run) {
        return;
    }
    // The caption, an age, changes more often than the figures, which cost much more to paint.
    const bool isCaption = text == m_text && run == m_run && caption.isEmpty() == m_caption.isEmpty();
    m_text = text;
    m_caption = caption;
    m_run = run;
    setAccessibleDescription(m_text + QLatin1Char(' ') + m_caption);
    update(isCaption ? captionPlace() : rect());
}

QRect ClockWidget::captionPlace() const {
    const int space = fontMetrics().height() / 2;
    const int height = m_caption.isEmpty() ? 0 : fontMetrics().height();
    return {space, rect().bottom() + 1 - space / 2 - height, width() - 2 * space, height};
}

void ClockWidget::paintEvent(QPaintEvent* event) {
    QPainter painter(this);
    painter.fillRect(rect(), theme().panel);
    const QRect below = captionPlace();
    painter.setPen(m_run == Run::Stale ? theme().error : theme().dim);
    painter.drawText(below, Qt::AlignCenter,
                     fontMetrics().elidedText(m_caption, Qt::ElideRight, below.width()));
    if (const QRect figures(below.left(), below.left() / 2, below.width(), below.top() - below.left() / 2);
        event->rect().intersects(figures)) {
        QFont large = monospaceFont();
        const bool isFree = isWindow() || window()->windowType() == Qt::Tool; // a dock that floats
        const double most =
            isFree ? figures.height()
                   : std::max(kMostInDock * fontMetrics().height(), kMostOfHeight * figures.height());
        large.setPixelSize(std::min(fittingPixelSize(large, m_text, figures.size()), qRound(most)));
        painter.setFont(large);
        painter.setPen(m_run == Run::Running ? theme().text : theme().dim);
        painter.drawText(figures, Qt::AlignCenter, m_text);
    }
    if (hasFocus() && !isWindow()) {
        painter.setPen(theme().accent);
        painter.setBrush(Qt::NoBrush);
        painter.drawRect(rect().adjusted(0, 0, -1, -1));
    }
}

void ClockWidget::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_F && event->modifiers() == Qt::NoModifier) {
        emit fullScreenToggled();
    } else if (event->key() == Qt::Key_Escape && isWindow()) {
        emit left();
    } else {
        QWidget::keyPressEvent(event);
    }
}

TimecodePanel::TimecodePanel(model::SessionView& view, Commands& commands, QWidget* parent)
    : Panel(view, commands, parent), m_facts(clockFacts(m_clock)) {
    setBackgroundRole(QPalette::Base);
    setAutoFillBackground(true);
    auto* layout = tightColumn(this);
    layout->addWidget(m_large, 1);
    const int space = fontMetrics().height() / 2;
    auto* choices = spacedRow({space, 0, space, space / 2}, space / 2);
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
    m_table->showFacts(m_facts);
    connect(m_large, &ClockWidget::fullScreenToggled, this, [this] { setFullScreen(true); });
    // In a low dock the clock keeps half the height, and what else there is to know of it is scrolled.
    new EventWatch(this, QEvent::Resize, [this, choices] {
        constexpr int kLeastRows = 1;
        const int room = height() - choices->sizeHint().height() - height() / 2;
        const int rows = room / m_table->heightForRows(1);
        const int all = m_table->model()->rowCount();
        m_table->setFixedHeight(m_table->heightForRows(std::clamp(rows, kLeastRows, all)));
        m_table->setVerticalScrollBarPolicy(rows < all ? Qt::ScrollBarAsNeeded : Qt::ScrollBarAlwaysOff);
    });
    showClock();
}

QToolButton* TimecodePanel::addChoice(const QString& text, ClockChoice choice) {
    QToolButton* button = framedButton(text, {}, this);
    button->setCheckable(true);
    button->setChecked(choice == m_choice);
    button->setAccessibleName(tr("Large clock: %1").arg(text));
    connect(button, &QToolButton::clicked, this, [this, choice] { choose(choice); });
    m_buttons[choice] = button;
    return button;
}

std::span<const ActionInfo> TimecodePanel::actionTable() {
    using Do = ActionsOf<TimecodePanel>;
    static constexpr const char* kClock = QT_TRANSLATE_NOOP("Action", "&View/Time c&ode");
    static constexpr ActionInfo kActions[] = {
        {"clockOfHeader", kClock, QT_TRANSLATE_NOOP("Action", "&Header"), "",
         Do::call<&TimecodePanel::choose, ClockChoice::Header>,
         Do::is<&TimecodePanel::choice, ClockChoice::Header>},
        {"clockOfType25", kClock, QT_TRANSLATE_NOOP("Action", "&Type 25"), "",
         Do::call<&TimecodePanel::choose, ClockChoice::Type25>,
         Do::is<&TimecodePanel::choice, ClockChoice::Type25>},
        {"clockFullScreen", kClock, QT_TRANSLATE_NOOP("Action", "On the &full screen"), "",
         Do::call<&TimecodePanel::setFullScreen, true>},
    };
    return kActions;
}

void TimecodePanel::choose(ClockChoice choice) {
    m_choice = choice;
    m_buttons[choice]->setChecked(true);
    showClock();
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
        return staleText(age());
    }
    return nameApart(m_view, *key);
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
