// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/inputs/connection_page.h"

#include "app/gui/models/text.h"

#include <QEvent>
#include <QGridLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>

#include <cmath>

namespace posewire::gui {

namespace {

struct Entry {
    Health level;
    QString text;
    QString remedy;
};

QLabel* proseLabel(QWidget* parent) {
    auto* label = new QLabel(parent);
    label->setWordWrap(true);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    return label;
}

/// A new text takes the selection away: only where it is new.
void setTextOf(QLabel& label, const QString& text) {
    if (label.text() != text) {
        label.setText(text);
    }
}

Entry allIsWell(const ReceivingState& receiving) {
    if (receiving.datagramsPerSecond <= 0) {
        return {Health::Unknown, ConnectionPage::tr("The inputs have just been opened."),
                ConnectionPage::tr("If nothing arrives within two seconds, the reason will be shown here.")};
    }
    return {Health::Good,
            ConnectionPage::tr("Datagrams are arriving: %1 per second.")
                .arg(grouped(static_cast<std::uint64_t>(std::lround(receiving.datagramsPerSecond)))),
            ConnectionPage::tr("No problem was found with the connection.")};
}

std::vector<Entry> entriesOf(const ReceivingState& receiving) {
    std::vector<Entry> entries;
    for (const net::Finding& finding : receiving.findings) {
        entries.push_back({healthOf(finding.kind), sentence(finding.text), sentence(finding.remedy)});
    }
    if (entries.empty()) {
        entries.push_back(allIsWell(receiving));
    }
    return entries;
}

} // namespace

Health healthOf(net::Finding::Kind kind) {
    using Kind = net::Finding::Kind;
    switch (kind) {
    case Kind::CannotOpen:
        return Health::Error;
    case Kind::OtherTransport:
    case Kind::FirewallOn:
        return Health::Unknown;
    default:
        return Health::Warning;
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

FindingView::FindingView(QWidget* parent)
    : QWidget(parent), m_symbol(new QLabel(this)), m_text(proseLabel(this)), m_remedy(proseLabel(this)) {
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
}

void FindingView::setFinding(Health level, const QString& text, const QString& remedy) {
    m_level = level;
    setTextOf(*m_symbol, level == Health::Unknown ? QStringLiteral("ⓘ") : healthSymbol(level));
    setTextOf(*m_text, text);
    setTextOf(*m_remedy, remedy);
    applyColours();
    setVisible(true);
}

void FindingView::applyColours() {
    QPalette palette = m_symbol->palette();
    const QColor colour = m_level == Health::Unknown ? theme().dim : healthColour(m_level);
    if (palette.color(QPalette::WindowText) != colour) {
        palette.setColor(QPalette::WindowText, colour);
        m_symbol->setPalette(palette);
    }
    update();
}

void FindingView::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) {
        applyColours();
    }
}

void FindingView::paintEvent(QPaintEvent* /*event*/) {
    constexpr qreal kRadius = 5;
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(theme().line);
    painter.setBrush(theme().panel);
    painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), kRadius, kRadius);
}

ConnectionPage::ConnectionPage(QWidget* parent) : QWidget(parent) {
    auto* content = new QWidget(this);
    m_column = new QVBoxLayout(content);
    m_column->setContentsMargins(0, 0, 0, 0);
    m_column->setSpacing(fontMetrics().height() / 2);
    m_column->addStretch(1);
    auto* area = new QScrollArea(this);
    area->setWidget(content);
    area->setWidgetResizable(true);
    area->setFrameShape(QFrame::NoFrame);
    auto* about = new QLabel(tr("What was found, the most certain first, and what to do about it."), this);
    about->setForegroundRole(QPalette::PlaceholderText);
    auto* copy = new QPushButton(tr("&Copy all"), this);
    auto* row = new QHBoxLayout;
    row->addWidget(about, 1);
    row->addWidget(copy);
    auto* column = new QVBoxLayout(this);
    column->setSpacing(fontMetrics().height() * 2 / 3);
    column->addLayout(row);
    column->addWidget(area, 1);
    connect(copy, &QPushButton::clicked, this, [this] { emit copyRequested(m_shown); });
}

void ConnectionPage::refresh(const ReceivingState& receiving) {
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
        m_views[i]->setFinding(entries[i].level, entries[i].text, entries[i].remedy);
        m_shown += entries[i].text + QLatin1Char('\n') + entries[i].remedy + QStringLiteral("\n\n");
    }
}

} // namespace posewire::gui
