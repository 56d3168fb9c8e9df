// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/inputs/inputs_dialog.h"

#include "app/gui/inputs/connection_page.h"
#include "app/gui/inputs/inputs_page.h"
#include "app/gui/inputs/relay_page.h"

#include <QDialogButtonBox>
#include <QTabWidget>
#include <QVBoxLayout>

namespace posewire::gui {

InputsDialog::InputsDialog(Receiving& receiving, QWidget* parent)
    : QDialog(parent),
      m_receiving(receiving),
      m_tabs(new QTabWidget(this)),
      m_inputs(new InputsPage(receiving, this)),
      m_relay(new RelayPage(receiving.relaying(), this)),
      m_help(new ConnectionPage(this)) {
    setObjectName(QStringLiteral("sourcesDialog"));
    setWindowTitle(tr("Inputs"));
    m_tabs->addTab(m_inputs, tr("&Inputs"));
    m_tabs->addTab(m_relay, tr("Re&lay"));
    m_tabs->addTab(m_help, tr("Connection &help"));
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    auto* column = new QVBoxLayout(this);
    column->addWidget(m_tabs, 1);
    column->addWidget(buttons);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(m_tabs, &QTabWidget::currentChanged, this, &InputsDialog::refresh);
    connect(m_inputs, &InputsPage::choicesChanged, this, &InputsDialog::choicesChanged);
    connect(m_inputs, &InputsPage::copyRequested, this, &InputsDialog::copyRequested);
    connect(m_inputs, &InputsPage::openFileRequested, this, &InputsDialog::openFileRequested);
    connect(m_relay, &RelayPage::choicesChanged, this, &InputsDialog::choicesChanged);
    connect(m_relay, &RelayPage::copyRequested, this, &InputsDialog::copyRequested);
    connect(m_help, &ConnectionPage::copyRequested, this, &InputsDialog::copyRequested);
    const QFontMetrics metrics = fontMetrics();
    resize(metrics.averageCharWidth() * 165, metrics.lineSpacing() * 36);
}

void InputsDialog::open(Page page) {
    m_tabs->setCurrentIndex(static_cast<int>(page));
    show();
    raise();
    activateWindow();
    m_tabs->currentWidget()->setFocus();
    refresh();
}

void InputsDialog::refresh() {
    if (!isVisible()) {
        return;
    }
    switch (static_cast<Page>(m_tabs->currentIndex())) {
    case Page::Inputs:
        m_inputs->refresh();
        return;
    case Page::Relay:
        m_relay->refresh();
        return;
    case Page::Help:
        m_help->refresh(m_receiving.state());
        return;
    }
}

} // namespace posewire::gui
