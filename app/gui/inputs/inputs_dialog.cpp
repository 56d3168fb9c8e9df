// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/inputs/inputs_dialog.h"

#include "app/gui/base/help_topics.h"
#include "app/gui/base/saving.h"
#include "app/gui/inputs/inputs_page.h"
#include "app/gui/inputs/relay_page.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/theme/words.h"

#include <QDialogButtonBox>
#include <QGridLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QScrollArea>
#include <QTabWidget>
#include <QVBoxLayout>

#include <cmath>
#include <vector>

namespace posewire::gui {

namespace {

struct Entry {
    Health level;
    QString text;
    QString remedy;
    QString helpPlace{}; ///< empty for none
};

QLabel* proseLabel(QWidget* parent) {
    auto* label = plainLabel(parent);
    label->setWordWrap(true);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    return label;
}

Health healthOf(net::Finding::Kind kind) {
    using Found = net::Finding::Kind;
    switch (kind) {
    case Found::CannotOpen:
    case Found::AddressGone:
        return Health::Error;
    case Found::OtherTransport:
    case Found::FirewallOn:
        return Health::Unknown;
    default:
        return Health::Warning;
    }
}

HelpTopic topicOf(net::Finding::Kind kind) {
    using Found = net::Finding::Kind;
    switch (kind) {
    case Found::NoInput:
        return HelpTopic::NoInput;
    case Found::CannotOpen:
        return HelpTopic::CannotListen;
    case Found::NotMxtp:
    case Found::GarbledPeer:
        return HelpTopic::NotMxtp;
    case Found::NotJoined:
        return HelpTopic::GroupNotJoined;
    case Found::NotReachable:
    case Found::SilentPeer:
        return HelpTopic::TcpTrouble;
    default:
        return HelpTopic::NothingArrives;
    }
}

QString sentence(const std::string& text) {
    QString sentence = QString::fromStdString(text).trimmed();
    if (!sentence.isEmpty()) {
        sentence[0] = sentence[0].toUpper();
        sentence += sentence.endsWith(QLatin1Char('.')) ? QString() : QStringLiteral(".");
    }
    return sentence;
}

Entry allIsWell(const ReceivingState& receiving) {
    if (receiving.datagramsPerSecond <= 0) {
        return {Health::Unknown, tr("The inputs have just been opened."),
                tr("If nothing arrives within two seconds, the reason will be shown here.")};
    }
    return {Health::Good,
            tr("Datagrams are arriving: %1 per second.")
                .arg(grouped(static_cast<std::uint64_t>(std::lround(receiving.datagramsPerSecond)))),
            tr("No problem was found with the connection.")};
}

std::vector<Entry> entriesOf(const ReceivingState& receiving) {
    std::vector<Entry> entries;
    for (const net::Finding& finding : receiving.findings) {
        entries.push_back({healthOf(finding.kind), sentence(finding.text), sentence(finding.remedy),
                           placeOf(topicOf(finding.kind))});
    }
    if (entries.empty()) {
        entries.push_back(allIsWell(receiving));
    }
    return entries;
}

/// One finding: what is known, and what to do.
class FindingView final : public QWidget {
public:
    explicit FindingView(QWidget* parent)
        : QWidget(parent),
          m_symbol(plainLabel(this)),
          m_text(proseLabel(this)),
          m_remedy(proseLabel(this)),
          m_help(flatButton(QStringLiteral("?"), tr("Help on this"), this)) {
        m_help->setFocusPolicy(Qt::TabFocus);
        connect(m_help, &QToolButton::clicked, this, [this] { openHelp(m_place); });
        QFont font = m_text->font();
        font.setWeight(QFont::DemiBold);
        m_text->setFont(font);
        const int unit = fontMetrics().height();
        auto* grid = new QGridLayout(this);
        grid->setContentsMargins(unit * 3 / 4, unit * 2 / 3, unit * 3 / 4, unit * 2 / 3);
        grid->setVerticalSpacing(unit / 4);
        grid->setColumnStretch(1, 1);
        m_symbol->setMinimumWidth(unit);
        grid->addWidget(m_symbol, 0, 0, Qt::AlignTop);
        grid->addWidget(m_text, 0, 1);
        grid->addWidget(m_remedy, 1, 1);
        grid->addWidget(m_help, 0, 2, Qt::AlignTop);
        new EventWatch(this, QEvent::PaletteChange, [this] { applyColours(); });
    }

    void setEntry(const Entry& entry) {
        m_level = entry.level;
        m_symbol->setText(m_level == Health::Unknown ? QStringLiteral("●") : healthSymbol(m_level));
        m_text->setText(entry.text);
        m_remedy->setText(entry.remedy);
        m_place = entry.helpPlace;
        m_help->setVisible(!m_place.isEmpty());
        applyColours();
        setVisible(true);
    }

protected:
    void paintEvent(QPaintEvent* /*event*/) override {
        constexpr qreal kRadius = 5;
        QPainter painter(this);
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setPen(theme().line);
        painter.setBrush(theme().panel);
        painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), kRadius, kRadius);
    }

private:
    void applyColours() {
        setTextColour(*m_symbol, m_level == Health::Unknown ? theme().dim : healthColour(m_level));
        update();
    }

    QLabel* m_symbol;
    QLabel* m_text;
    QLabel* m_remedy;
    QToolButton* m_help;
    QString m_place;
    Health m_level = Health::Unknown;
};

} // namespace

/// Why no characters are seen, as long as it is open; says so where nothing is wrong.
class ConnectionPage final : public QWidget {
public:
    explicit ConnectionPage(QWidget* parent) : QWidget(parent) {
        auto* content = new QWidget(this);
        m_column = new QVBoxLayout(content);
        m_column->setContentsMargins(0, 0, 0, 0);
        m_column->setSpacing(fontMetrics().height() / 2);
        m_column->addStretch(1);
        auto* area = new QScrollArea(this);
        area->setWidget(content);
        area->setWidgetResizable(true);
        area->setFrameShape(QFrame::NoFrame);
        auto* about = dimLabel(tr("What was found, the most certain first, and what to do about it."), this);
        auto* copy = new QPushButton(tr("&Copy all"), this);
        auto* row = new QHBoxLayout;
        row->addWidget(about, 1);
        row->addWidget(copy);
        auto* column = new QVBoxLayout(this);
        column->setSpacing(fontMetrics().height() * 2 / 3);
        column->addLayout(row);
        column->addWidget(area, 1);
        connect(copy, &QPushButton::clicked, this,
                [this] { copyText(m_shown); });
    }

    void refresh(const ReceivingState& receiving) {
        const std::vector<Entry> entries = entriesOf(receiving);
        while (m_views.size() < entries.size()) {
            m_views.push_back(new FindingView(this));
            m_column->insertWidget(static_cast<int>(m_views.size()) - 1, m_views.back());
        }
        m_shown.clear();
        for (std::size_t i = 0; i < m_views.size(); ++i) {
            if (i >= entries.size()) {
                m_views[i]->setVisible(false);
                continue;
            }
            m_views[i]->setEntry(entries[i]);
            m_shown += entries[i].text + QLatin1Char('\n') + entries[i].remedy + QStringLiteral("\n\n");
        }
    }

    /// All that is shown, as lines.
    [[nodiscard]] const QString& text() const { return m_shown; }

private:
    QVBoxLayout* m_column;
    std::vector<FindingView*> m_views;
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
