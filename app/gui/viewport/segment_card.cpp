// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/segment_card.h"

#include "app/gui/theme/words.h"

#include <QEvent>
#include <QFontMetricsF>
#include <QPainter>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace posewire::gui {
namespace {

constexpr int kEdge = 12;
constexpr qreal kMargin = 10;
constexpr qreal kBetween = 8;

qreal rowHeight(const QFontMetricsF& metrics) {
    return std::ceil(1.15 * metrics.height());
}

QFont titleFont() {
    QFont font = tabularFont();
    font.setWeight(QFont::DemiBold);
    return font;
}

bool isVector(const SegmentFact& fact) {
    return !fact.values[2].isEmpty();
}

QString spoken(const SegmentFact& fact) {
    QStringList values;
    for (const QString& value : fact.values) {
        if (!value.isEmpty()) {
            values += value;
        }
    }
    return QStringLiteral("%1 %2 %3").arg(fact.name, values.join(QLatin1Char(' ')), fact.unit).trimmed();
}

} // namespace

SegmentCard::SegmentCard(QWidget* parent, const QWidget& banner) : QWidget(parent), m_banner(banner) {
    setObjectName(QStringLiteral("segmentCard"));
    setAttribute(Qt::WA_TransparentForMouseEvents);
    hide();
}

void SegmentCard::setFacts(std::optional<SegmentFacts> facts) {
    if (facts == m_facts) {
        place();
        return;
    }
    m_facts = std::move(facts);
    if (m_facts) {
        QStringList all{m_facts->source};
        for (const SegmentFact& fact : m_facts->facts) {
            all += spoken(fact);
        }
        setAccessibleName(tr("%1 of %2").arg(m_facts->segment, m_facts->character));
        setAccessibleDescription(all.join(QStringLiteral(". ")));
    }
    place();
    update();
}

SegmentCard::Columns SegmentCard::columns() const {
    const QFontMetricsF metrics(tabularFont());
    Columns columns;
    columns.value = metrics.horizontalAdvance(QStringLiteral("−0.000"));
    for (const SegmentFact& fact : m_facts->facts) {
        columns.name = std::max(columns.name, metrics.horizontalAdvance(fact.name));
        columns.unit = std::max(columns.unit, metrics.horizontalAdvance(fact.unit));
        for (const QString& value : fact.values) {
            columns.value = std::max(columns.value, metrics.horizontalAdvance(value));
        }
        columns.count = fact.values[0].isEmpty() ? columns.count : 4;
    }
    return columns;
}

QSizeF SegmentCard::wantedSize() const {
    const Columns wanted = columns();
    const QFontMetricsF metrics(tabularFont());
    const qreal title = QFontMetricsF(titleFont()).horizontalAdvance(m_facts->segment) + kBetween +
                        metrics.horizontalAdvance(m_facts->character) + 1.4 * metrics.height();
    const qreal table = wanted.name + wanted.count * (kBetween + wanted.value) + kBetween / 2 + wanted.unit;
    const qreal width = std::max({std::min(title, table * 1.3), table});
    const QRectF source = metrics.boundingRect(QRectF(0, 0, width, 1000), Qt::TextWordWrap, m_facts->source);
    const auto rows = static_cast<qreal>(m_facts->facts.size()) + 2.3; // title and heads
    return {std::ceil(width + 2 * kMargin),
            std::ceil(rows * rowHeight(metrics) + source.height() + 2 * kMargin)};
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
    const QSize size = wantedSize().toSize();
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
    if (!m_facts) {
        return;
    }
    constexpr double kOpacity = 0.92;
    constexpr double kRadius = 5;
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(theme().line);
    painter.setBrush(withAlpha(theme().raised, kOpacity));
    painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), kRadius, kRadius);
    painter.setFont(titleFont());
    const QFontMetricsF metrics(tabularFont());
    const qreal row = rowHeight(metrics);
    const qreal side = 0.65 * metrics.height();
    const qreal right = width() - kMargin;
    QRectF line(kMargin, kMargin, right - kMargin, row);
    painter.setPen(theme().text);
    painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter, m_facts->segment);
    line.setLeft(kMargin + QFontMetricsF(titleFont()).horizontalAdvance(m_facts->segment) + kBetween);
    paintMark(painter, QRectF(line.left(), line.center().y() - side / 2, side, side), m_facts->mark);
    line.setLeft(line.left() + 1.4 * side);
    painter.setFont(tabularFont());
    painter.setPen(theme().dim);
    painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter,
                     metrics.elidedText(m_facts->character, Qt::ElideRight, line.width()));
    QRectF source(kMargin, kMargin + row, right - kMargin, height());
    const bool isWarning = m_facts->sourceHealth == Health::Warning;
    painter.setPen(isWarning ? healthColour(Health::Warning) : theme().dim);
    QRectF used;
    painter.drawText(source, Qt::AlignLeft | Qt::AlignTop | Qt::TextWordWrap, m_facts->source, &used);
    paintFacts(painter, used.bottom() + 0.15 * row);
}

void SegmentCard::paintFacts(QPainter& painter, qreal top) const {
    const Columns wide = columns();
    const qreal row = rowHeight(QFontMetricsF(tabularFont()));
    const qreal unitLeft = width() - kMargin - wide.unit;
    const auto valueRoom = [&](std::size_t column, qreal y) {
        const qreal right =
            unitLeft - kBetween / 2 - static_cast<qreal>(3 - column) * (kBetween + wide.value);
        return QRectF(right - wide.value, y, wide.value, row);
    };
    const std::array<std::pair<const char*, QColor>, 4> heads{
        {{"w", theme().dim}, {"x", theme().axisX}, {"y", theme().axisY}, {"z", theme().axisZ}}};
    for (std::size_t column = wide.count == 4 ? 0 : 1; column < heads.size(); ++column) {
        painter.setPen(heads[column].second);
        painter.drawText(valueRoom(column, top), Qt::AlignRight | Qt::AlignVCenter,
                         QLatin1String(heads[column].first));
    }
    for (const SegmentFact& fact : m_facts->facts) {
        top += row;
        painter.setPen(theme().dim);
        painter.drawText(QRectF(kMargin, top, width(), row), Qt::AlignLeft | Qt::AlignVCenter, fact.name);
        painter.drawText(QRectF(unitLeft, top, wide.unit + 2, row), Qt::AlignLeft | Qt::AlignVCenter,
                         fact.unit);
        painter.setPen(theme().text);
        for (std::size_t column = 0; column < fact.values.size(); ++column) {
            // A plain number stands at the right, under no head.
            const std::size_t shown = isVector(fact) ? column : 3;
            painter.drawText(valueRoom(shown, top), Qt::AlignRight | Qt::AlignVCenter, fact.values[column]);
        }
    }
}

void SegmentCard::changeEvent(QEvent* event) {
    if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) {
        place();
        update();
    }
    QWidget::changeEvent(event);
}

} // namespace posewire::gui
