// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/inputs/inputs_dialog.h"

#include "app/gui/base/saving.h"
#include "app/gui/inputs/inputs_page.h"
#include "app/gui/inputs/relay_page.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/theme/words.h"

#include <QDialogButtonBox>
#include <QLabel>
#include <QPushButton>
#include <QTabWidget>
#include <QTextBrowser>
#include <QVBoxLayout>

#include <cmath>
#include <vector>

namespace posewire::gui {

namespace {

Advice allIsWell(const ReceivingState& receiving) {
    if (receiving.datagramsPerSecond <= 0) {
        return {Health::Unknown, tr("The inputs have just been opened."),
                tr("If nothing arrives within two seconds, the reason will be shown here.")};
    }
    return {Health::Good,
            tr("Datagrams are arriving: %1 per second.")
                .arg(grouped(static_cast<std::uint64_t>(std::lround(receiving.datagramsPerSecond)))),
            tr("No problem was found with the connection.")};
}

/// A mark in the colour of its level, what is known, below it what to do, and a link into the guide.
QString htmlOf(const Advice& advice) {
    const bool isKnown = advice.level != Health::Unknown;
    const QString mark = isKnown ? healthSymbol(advice.level) : QStringLiteral("●");
    const QColor colour = isKnown ? healthColour(advice.level) : theme().dim;
    const QString link =
        advice.topic
            ? QStringLiteral(" <a href=\"%1\">%2</a>").arg(placeOf(*advice.topic), tr("Help on this"))
            : QString();
    return QStringLiteral("<table cellpadding=\"6\"><tr><td style=\"color: %1\">%2</td>"
                          "<td><b>%3</b><br>%4%5</td></tr></table>")
        .arg(colour.name(), mark, advice.text.toHtmlEscaped(), advice.remedy.toHtmlEscaped(), link);
}

} // namespace

/// Why no characters are seen, as long as it is open; says so if nothing is wrong.
class ConnectionPage final : public QWidget {
public:
    explicit ConnectionPage(QWidget* parent) : QWidget(parent), m_findings(new QTextBrowser(this)) {
        m_findings->setAccessibleName(tr("What was found"));
        m_findings->setOpenLinks(false);
        setFocusProxy(m_findings);
        auto* about = dimLabel(tr("What was found, the most certain first, and what to do about it."), this);
        auto* copy = new QPushButton(tr("&Copy all"), this);
        auto* row = new QHBoxLayout;
        row->addWidget(about, 1);
        row->addWidget(copy);
        auto* column = new QVBoxLayout(this);
        column->setSpacing(fontMetrics().height() * 2 / 3);
        column->addLayout(row);
        column->addWidget(m_findings, 1);
        connect(m_findings, &QTextBrowser::anchorClicked, this,
                [](const QUrl& place) { openHelp(place.toString()); });
        connect(copy, &QPushButton::clicked, this, [this] { copyText(m_shown); });
    }

    void refresh(const ReceivingState& receiving) {
        std::vector<Advice> all = adviceOn(receiving);
        if (all.empty()) {
            all.push_back(allIsWell(receiving));
        }
        m_shown.clear();
        QString html;
        for (const Advice& advice : all) {
            m_shown += advice.text + QLatin1Char('\n') + advice.remedy + QStringLiteral("\n\n");
            html += htmlOf(advice);
        }
        if (html != m_html) { // else what is selected in it stays
            m_html = html;
            m_findings->setHtml(html);
        }
    }

    /// All that is shown, as lines.
    [[nodiscard]] const QString& text() const { return m_shown; }

private:
    QTextBrowser* m_findings;
    QString m_html;
    QString m_shown;
};

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
    offerHelp(*this, *buttons, placeOf(HelpTopic::Inputs));
    connect(m_tabs, &QTabWidget::currentChanged, this, &InputsDialog::refresh);
    connect(m_inputs, &InputsPage::choicesChanged, this, &InputsDialog::choicesChanged);
    connect(m_inputs, &InputsPage::openFileRequested, this, &InputsDialog::openFileRequested);
    connect(m_relay, &RelayPage::choicesChanged, this, &InputsDialog::choicesChanged);
    const QFontMetrics metrics = fontMetrics();
    resize(metrics.averageCharWidth() * 165, metrics.lineSpacing() * 36);
}

QString InputsDialog::helpText() const {
    return m_help->text();
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
