// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/segment_card.h"

#include "app/gui/theme/words.h"
#include "app/gui/viewport/viewport_overlay.h"

#include <QEvent>
#include <QPainter>

#include <algorithm>
#include <array>
#include <utility>

namespace posewire::gui {
namespace {

constexpr int kEdge = 12;
constexpr int kMargin = 10;

QString spoken(const SegmentFact& fact) {
    QStringList values(fact.values.begin(), fact.values.end());
    values.removeAll(QString());
    return QStringLiteral("%1 %2 %3").arg(fact.name, values.join(QLatin1Char(' ')), fact.unit).trimmed();
}

QString cell(const QString& text, const QColor& colour, const char* attributes = "") {
    return QStringLiteral("<td style=\"color:%1;padding-left:8px\" %2>%3</td>")
        .arg(colour.name(), QLatin1String(attributes), text.toHtmlEscaped());
}

/// A row for each fact: w x y z in columns; plain numbers are in the last one, under no head.
QString tableOf(const SegmentFacts& known) {
    const bool hasW =
        std::ranges::any_of(known.facts, [](const SegmentFact& fact) { return !fact.values[0].isEmpty(); });
    const std::array<std::pair<const char*, QColor>, 4> heads{
        {{"w", theme().dim}, {"x", theme().axisX}, {"y", theme().axisY}, {"z", theme().axisZ}}};
    const std::size_t first = hasW ? 0 : 1;
    const int least = QFontMetrics(tabularFont()).horizontalAdvance(QStringLiteral("−0.000"));
    const QByteArray head = QByteArrayLiteral("align=right width=") + QByteArray::number(least + 8);
    QString html = QStringLiteral("<table cellspacing=0><tr><td></td>");
    for (std::size_t column = first; column < heads.size(); ++column) {
        html += cell(QLatin1String(heads[column].first), heads[column].second, head);
    }
    for (const SegmentFact& fact : known.facts) {
        const bool isVector = !fact.values[2].isEmpty();
        html += QStringLiteral("</tr><tr><td style=\"color:%1\">%2</td>")
                    .arg(theme().dim.name(), fact.name.toHtmlEscaped());
        for (std::size_t column = first; column < heads.size(); ++column) {
            const QString plain = column + 1 == heads.size() ? fact.values[1] : QString();
            html += cell(isVector ? fact.values[column] : plain, theme().text, "align=right");
        }
        html += cell(fact.unit, theme().dim);
    }
    return html + QStringLiteral("</tr></table>");
}

} // namespace

SegmentCard::SegmentCard(QWidget* parent, const QWidget& banner)
    : QWidget(parent), m_banner(banner), m_table(richLabel(this)) {
    setObjectName(QStringLiteral("segmentCard"));
    setAttribute(Qt::WA_TransparentForMouseEvents);
    QVBoxLayout* column = tightColumn(this);
    column->setContentsMargins(kMargin, kMargin, kMargin, kMargin);
    QHBoxLayout* title = spacedRow({}, 8);
    title->addWidget(m_segment);
    title->addWidget(m_mark);
    title->addWidget(m_character, 1);
    column->addLayout(title);
    column->addWidget(m_source);
    column->addWidget(m_table);
    m_source->setWordWrap(true);
    hide();
}

void SegmentCard::setFacts(std::optional<SegmentFacts> facts) {
    if (facts != m_facts) {
        m_facts = std::move(facts);
        showFacts();
    }
    place();
}

void SegmentCard::showFacts() {
    if (!m_facts) {
        return;
    }
    QFont bold = tabularFont();
    bold.setWeight(QFont::DemiBold);
    m_segment->setFont(bold);
    m_segment->setText(m_facts->segment);
    const int side = qRound(0.65 * QFontMetrics(tabularFont()).height());
    m_mark->setFixedSize(side, side);
    m_character->setText({}, m_facts->character);
    m_source->setText(m_facts->source);
    const bool isWarning = m_facts->sourceHealth == Health::Warning;
    setTextColour(*m_source, isWarning ? healthColour(Health::Warning) : theme().dim);
    m_table->setFont(tabularFont());
    m_table->setText(tableOf(*m_facts));
    QStringList all{m_facts->source};
    for (const SegmentFact& fact : m_facts->facts) {
        all += spoken(fact);
    }
    setAccessibleName(tr("%1 of %2").arg(m_facts->segment, m_facts->character));
    setAccessibleDescription(all.join(QStringLiteral(". ")));
    update();
}

QRect SegmentCard::cornerFor(const QSize& size, bool isLeft) const {
    const QRect room = parentWidget()->rect().adjusted(kEdge, kEdge, -kEdge, -kEdge);
    QRect card(QPoint(), size);
    card.moveBottomRight(room.bottomRight());
    if (isLeft) {
        card.moveLeft(room.left());
    }
    if (m_banner.isVisible() && m_banner.geometry().intersects(card)) {
        card.moveBottom(m_banner.y() - kEdge);
    }
    return card;
}

void SegmentCard::place() {
    if (!m_facts) {
        m_isLeft = false;
        hide();
        return;
    }
    constexpr double kMost = 0.6;
    constexpr double kBetter = 0.5; // of what it covers: a figure that moves does not make it jump
    layout()->activate();           // rows remember the height of their last text otherwise
    // As wide as the table, a little wider for a long name.
    const int table = m_table->sizeHint().width();
    const int title = layout()->itemAt(0)->sizeHint().width();
    const int width = std::clamp(title, table, table * 13 / 10) + 2 * kMargin;
    const QSize size(width, layout()->totalHeightForWidth(width));
    const QRect room = parentWidget()->rect().adjusted(kEdge, kEdge, -kEdge, -kEdge);
    const auto covered = [&](bool isLeft) {
        const QRectF common = QRectF(cornerFor(size, isLeft)) & m_seen;
        return common.width() * common.height();
    };
    m_isLeft = covered(!m_isLeft) < kBetter * covered(m_isLeft) ? !m_isLeft : m_isLeft;
    m_isLeft = m_pointer && cornerFor(size, m_isLeft).contains(*m_pointer) ? !m_isLeft : m_isLeft;
    const QRect card = cornerFor(size, m_isLeft);
    setGeometry(card);
    setVisible(card.width() <= kMost * room.width() && card.height() <= kMost * room.height());
}

void SegmentCard::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    paintPlate(painter, rect(), theme().line, 0.92);
    if (m_facts) {
        paintMark(painter, m_mark->geometry(), m_facts->mark);
    }
}

void SegmentCard::changeEvent(QEvent* event) {
    if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) {
        showFacts();
        place();
    }
    QWidget::changeEvent(event);
}

} // namespace posewire::gui
