// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/inputs/inputs_dialog.h"

#include "app/gui/base/saving.h"
#include "app/gui/inputs/inputs_page.h"
#include "app/gui/inputs/ways_out_page.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/theme/words.h"

#include <QDialogButtonBox>
#include <QPushButton>
#include <QTextBrowser>
#include <QVBoxLayout>

#include <cmath>
#include <functional>
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

/// Before the place of an advice whose offer is taken.
constexpr QLatin1String kOffer("offer:");

/// A mark in the colour of its level, what is known, below it what to do, what would show it, and a link into
/// the guide.
QString htmlOf(const Advice& advice, std::size_t place) {
    const bool isKnown = advice.level != Health::Unknown;
    const QString mark = isKnown ? healthSymbol(advice.level) : QStringLiteral("●");
    const QColor colour = isKnown ? healthColour(advice.level) : theme().dim;
    const QString link =
        advice.topic
            ? QStringLiteral(" <a href=\"%1\">%2</a>").arg(placeOf(*advice.topic), tr("Help on this"))
            : QString();
    const QString offer = advice.offer
                              ? QStringLiteral(" <a href=\"%1%2\">%3</a>")
                                    .arg(kOffer)
                                    .arg(place)
                                    .arg(tr("Listen on %1").arg(displayText(*advice.offer)).toHtmlEscaped())
                              : QString();
    return QStringLiteral("<table cellpadding=\"6\"><tr><td style=\"color: %1\">%2</td>"
                          "<td><b>%3</b><br>%4%5%6</td></tr></table>")
        .arg(colour.name(), mark, advice.text.toHtmlEscaped(), advice.remedy.toHtmlEscaped(), offer, link);
}

} // namespace

/// Why no characters are seen, as long as it is open; says so if nothing is wrong.
class ConnectionPage final : public QWidget {
public:
    /// `take`: opens an input that an advice offers.
    ConnectionPage(const std::function<void(const InputAddress&)>& take, QWidget* parent) : QWidget(parent) {
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
        connect(m_findings, &QTextBrowser::anchorClicked, this, [this, take](const QUrl& link) {
            if (const QString place = link.toString(); place.startsWith(kOffer)) {
                take(m_offers.at(place.mid(kOffer.size()).toUInt()));
            } else {
                openHelp(place);
            }
        });
        connect(copy, &QPushButton::clicked, this, [this] { copyText(m_shown); });
    }

    void refresh(const ReceivingState& receiving) {
        std::vector<Advice> all = adviceOn(receiving);
        if (all.empty()) {
            all.push_back(allIsWell(receiving));
        }
        m_shown.clear();
        m_offers.clear();
        QString html;
        for (const Advice& advice : all) {
            m_shown += advice.text + QLatin1Char('\n') + advice.remedy + QStringLiteral("\n\n");
            html += htmlOf(advice, m_offers.size());
            m_offers.push_back(advice.offer.value_or(InputAddress()));
        }
        if (html != m_html) { // else what is selected in it stays
            m_html = html;
            m_findings->setHtml(html);
        }
    }

private:
    QTextBrowser* m_findings = new QTextBrowser(this);
    std::vector<InputAddress> m_offers; ///< one for each advice
    QString m_html;
    QString m_shown;
};

InputsDialog::InputsDialog(Receiving& receiving, QWidget* parent)
    : QDialog(parent),
      m_receiving(receiving),
      m_inputs(new InputsPage(receiving, this)),
      m_waysOut(new WaysOutPage(receiving.waysOut(), this)),
      m_help(new ConnectionPage([this](const InputAddress& offer) { takeOffer(offer); }, this)) {
    setObjectName(QStringLiteral("sourcesDialog"));
    setWindowTitle(tr("Inputs and ways out"));
    m_tabs->addTab(m_inputs, tr("&Inputs"));
    m_tabs->addTab(m_waysOut, tr("&Ways out"));
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
    connect(m_waysOut, &WaysOutPage::choicesChanged, this, &InputsDialog::choicesChanged);
    const QFontMetrics metrics = fontMetrics();
    resize(metrics.averageCharWidth() * 165, metrics.lineSpacing() * 36);
}

void InputsDialog::takeOffer(const InputAddress& offer) {
    m_inputs->endEditing();
    m_inputs->form().setInput(offer);
    m_inputs->submit();
    m_tabs->setCurrentIndex(static_cast<int>(Page::Inputs)); // which says what went wrong, if it did
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
    case Page::WaysOut:
        m_waysOut->refresh();
        return;
    case Page::Help:
        m_help->refresh(m_receiving.state());
        return;
    }
}

} // namespace posewire::gui
