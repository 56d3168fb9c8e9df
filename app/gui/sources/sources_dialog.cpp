// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/sources/sources_dialog.h"

#include "app/gui/sources/connection_page.h"
#include "app/gui/sources/relay_page.h"
#include "app/gui/sources/sources_page.h"

#include <QDialogButtonBox>
#include <QTabWidget>
#include <QVBoxLayout>

namespace posewire::gui {

SourcesDialog::SourcesDialog(Receiving& receiving, QWidget* parent)
    : QDialog(parent),
      m_receiving(receiving),
      m_tabs(new QTabWidget(this)),
      m_sources(new SourcesPage(receiving, this)),
      m_relay(new RelayPage(receiving.relaying(), this)),
      m_help(new ConnectionPage(this)) {
    setObjectName(QStringLiteral("sourcesDialog"));
    setWindowTitle(tr("Sources"));
    m_tabs->addTab(m_sources, tr("&Sources"));
    m_tabs->addTab(m_relay, tr("Re&lay"));
    m_tabs->addTab(m_help, tr("Connection &help"));
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    auto* column = new QVBoxLayout(this);
    column->addWidget(m_tabs, 1);
    column->addWidget(buttons);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(m_tabs, &QTabWidget::currentChanged, this, &SourcesDialog::refresh);
    connect(m_sources, &SourcesPage::choicesChanged, this, &SourcesDialog::choicesChanged);
    connect(m_sources, &SourcesPage::copyRequested, this, &SourcesDialog::copyRequested);
    connect(m_sources, &SourcesPage::openFileRequested, this, &SourcesDialog::openFileRequested);
    connect(m_relay, &RelayPage::choicesChanged, this, &SourcesDialog::choicesChanged);
    connect(m_relay, &RelayPage::copyRequested, this, &SourcesDialog::copyRequested);
    connect(m_help, &ConnectionPage::copyRequested, this, &SourcesDialog::copyRequested);
    const QFontMetrics metrics = fontMetrics();
    resize(metrics.averageCharWidth() * 165, metrics.lineSpacing() * 36);
}

void SourcesDialog::open(Page page) {
    m_tabs->setCurrentIndex(static_cast<int>(page));
    show();
    raise();
    activateWindow();
    m_tabs->currentWidget()->setFocus();
    refresh();
}

void SourcesDialog::refresh() {
    if (!isVisible()) {
        return;
    }
    switch (static_cast<Page>(m_tabs->currentIndex())) {
    case Page::Sources:
        m_sources->refresh();
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
