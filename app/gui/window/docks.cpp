// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/docks.h"

#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/theme/icons.h"
#include "app/gui/theme/plain_text.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/theme/words.h"

#include <QApplication>
#include <QDockWidget>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QScrollArea>
#include <QToolButton>

#include <algorithm>

namespace posewire::gui {

namespace {

QToolButton* flatButton(const QString& name, QWidget* parent) {
    auto* button = new QToolButton(parent);
    button->setProperty("flat", true);
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::NoFocus);
    button->setAccessibleName(name);
    button->setToolTip(toolTipText(name));
    button->setVisible(false);
    return button;
}

constexpr int kLeastLines = 3;
/// Of the edge that shows where the keyboard is.
constexpr int kKeyboardMark = 3;

/// What the content needs at a width without being squeezed.
int leastHeight(const QWidget& content, int width) {
    const QLayout* layout = content.layout();
    const bool isWrapping = layout != nullptr && layout->hasHeightForWidth();
    return isWrapping ? layout->totalMinimumHeightForWidth(width) : content.minimumSizeHint().height();
}

class DockScroll final : public QScrollArea {
public:
    DockScroll(QWidget* content, QWidget* parent) : QScrollArea(parent) {
        setFrameShape(QFrame::NoFrame);
        setFocusPolicy(Qt::NoFocus);
        setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
        setWidget(content);
    }

    [[nodiscard]] QSize sizeHint() const override {
        return widget()->sizeHint().expandedTo(minimumSizeHint());
    }
    [[nodiscard]] QSize minimumSizeHint() const override {
        const QSize content = widget()->minimumSizeHint();
        return {content.width(), std::min(content.height(), fontMetrics().height() * kLeastLines)};
    }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override {
        const bool isDone = QScrollArea::eventFilter(watched, event);
        if (watched == widget() && event->type() == QEvent::LayoutRequest) {
            fitContent();
            updateGeometry();
        }
        return isDone;
    }
    void resizeEvent(QResizeEvent* event) override {
        QScrollArea::resizeEvent(event);
        fitContent();
    }

private:
    /// QScrollArea's own fitting would give content with wrapped texts the height it likes best.
    void fitContent() {
        const int width = viewport()->width();
        const int height = std::max(maximumViewportSize().height(), leastHeight(*widget(), width));
        widget()->resize(width, height);
    }
};

} // namespace

DockTitle::DockTitle(QDockWidget* dock)
    : QWidget(dock),
      m_title(plainLabel(dock->windowTitle(), this)),
      m_summary(new ElidedLabel(Qt::AlignRight, this)),
      m_help(helpButton(dock->windowTitle(), dock->objectName(), this)),
      m_float(flatButton(tr("Float or dock"), this)),
      m_close(flatButton(tr("Close"), this)) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(10, 0, 8, 1);
    row->setSpacing(2);
    row->addWidget(m_title);
    row->addSpacing(8);
    row->addWidget(m_summary, 1);
    row->addSpacing(2);
    // Those that come with the pointer are before the one that is always there, or they would slip under it.
    row->addWidget(m_float);
    row->addWidget(m_close);
    row->addWidget(m_help);
    connect(m_float, &QToolButton::clicked, dock, [dock] { dock->setFloating(!dock->isFloating()); });
    connect(m_close, &QToolButton::clicked, dock, &QDockWidget::close);
    connect(qApp, &QApplication::focusChanged, this, [this] { update(); });
    new EventWatch(this, QEvent::PaletteChange, [this] { restyle(); });
    new EventWatch(dock, QEvent::Paint,
                   [dock] { // afloat it has no other edge, and lies on what looks the same
                       if (dock->isFloating()) {
                           QPainter(dock).fillRect(dock->rect(), theme().dim);
                       }
                   });
    new EventWatch(this, QEvent::Enter, [this] { showButtons(true); });
    new EventWatch(this, QEvent::Leave, [this] { showButtons(false); });
    restyle();
}

void DockTitle::restyle() {
    QFont font = this->font();
    font.setWeight(QFont::DemiBold);
    m_title->setFont(font);
    m_summary->setFont(tabularFont());
    const QColor sign = theme().dim;
    QPalette dim = palette();
    dim.setColor(QPalette::ButtonText, sign);
    m_help->setPalette(dim);
    m_help->setFont(font);
    const int side = fontMetrics().height() - 2;
    for (auto* button : {m_float, m_close}) {
        button->setIconSize({side, side});
    }
    m_float->setIcon(themedIcon(QStringLiteral("float"), sign));
    m_close->setIcon(themedIcon(QStringLiteral("close"), sign));
    updateGeometry();
}

QSize DockTitle::sizeHint() const {
    return {QWidget::sizeHint().width(), fontMetrics().height() + 13};
}

QSize DockTitle::minimumSizeHint() const {
    return {m_title->sizeHint().width() + m_help->sizeHint().width() + 20, sizeHint().height()};
}

void DockTitle::setSummary(const QString& summary) {
    m_summary->setText({}, summary);
}

void DockTitle::setTabbed(bool isTabbed) {
    if (isTabbed == m_title->isVisibleTo(this)) {
        m_title->setVisible(!isTabbed);
        m_summary->setAlignment(isTabbed ? Qt::AlignLeft : Qt::AlignRight);
    }
}

bool DockTitle::hasKeyboard() const {
    return parentWidget()->isAncestorOf(QApplication::focusWidget());
}

void DockTitle::showButtons(bool isShown) {
    m_float->setVisible(isShown);
    m_close->setVisible(isShown);
}

void DockTitle::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.fillRect(rect(), theme().header);
    painter.fillRect(QRect(0, height() - 1, width(), 1), theme().line);
    if (hasKeyboard()) {
        painter.fillRect(QRect(0, 0, kKeyboardMark, height() - 1), theme().accent);
    }
}

QWidget* scrolling(QWidget* content, QDockWidget* dock) {
    return new DockScroll(content, dock);
}

} // namespace posewire::gui
