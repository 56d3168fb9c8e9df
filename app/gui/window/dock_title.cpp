// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/dock_title.h"

#include "app/gui/theme/icons.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"

#include <QDockWidget>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QToolButton>

namespace posewire::gui {

namespace {

QToolButton* flatButton(const QString& name, QWidget* parent) {
    auto* button = new QToolButton(parent);
    button->setProperty("flat", true);
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::NoFocus);
    button->setAccessibleName(name);
    button->setToolTip(name);
    button->setVisible(false);
    return button;
}

} // namespace

DockTitle::DockTitle(QDockWidget* dock)
    : QWidget(dock),
      m_title(new QLabel(dock->windowTitle(), this)),
      m_summary(new ElidedLabel(Qt::AlignRight, this)),
      m_float(flatButton(tr("Float or dock"), this)),
      m_close(flatButton(tr("Close"), this)) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(10, 0, 8, 1);
    row->setSpacing(2);
    row->addWidget(m_title);
    row->addSpacing(8);
    row->addWidget(m_summary, 1);
    row->addSpacing(2);
    row->addWidget(m_float);
    row->addWidget(m_close);
    connect(m_float, &QToolButton::clicked, dock, [dock] { dock->setFloating(!dock->isFloating()); });
    connect(m_close, &QToolButton::clicked, dock, &QDockWidget::close);
    restyle();
}

void DockTitle::restyle() {
    QFont font = this->font();
    font.setWeight(QFont::DemiBold);
    m_title->setFont(font);
    m_summary->setFont(tabularFont());
    const int side = fontMetrics().height() - 2;
    for (auto* button : {m_float, m_close}) {
        button->setIconSize({side, side});
    }
    m_float->setIcon(themedIcon(QStringLiteral("float"), theme().dim));
    m_close->setIcon(themedIcon(QStringLiteral("close"), theme().dim));
    updateGeometry();
}

QSize DockTitle::sizeHint() const {
    return {QWidget::sizeHint().width(), fontMetrics().height() + 13};
}

QSize DockTitle::minimumSizeHint() const {
    return {m_title->sizeHint().width() + 18, sizeHint().height()};
}

void DockTitle::setSummary(const QString& summary) {
    m_summary->setText({}, summary);
}

void DockTitle::showButtons(bool isShown) {
    m_float->setVisible(isShown);
    m_close->setVisible(isShown);
}

void DockTitle::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.fillRect(rect(), theme().header);
    painter.fillRect(QRect(0, height() - 1, width(), 1), theme().line);
}

void DockTitle::enterEvent(QEnterEvent* /*event*/) {
    showButtons(true);
}

void DockTitle::leaveEvent(QEvent* /*event*/) {
    showButtons(false);
}

void DockTitle::changeEvent(QEvent* event) {
    if (event->type() == QEvent::PaletteChange) {
        restyle();
    }
    QWidget::changeEvent(event);
}

} // namespace posewire::gui
