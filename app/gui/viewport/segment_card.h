// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/widgets.h"
#include "app/gui/viewport/segment_facts.h"

#include <QPoint>
#include <QRectF>
#include <QWidget>
#include <Qt>

#include <optional>

namespace posewire::gui {

class SegmentCard final : public QWidget {
    Q_OBJECT

public:
    /// Keeps off the banner at the lower edge.
    SegmentCard(QWidget* parent, const QWidget& banner);

    /// Nothing hides it.
    void setFacts(std::optional<SegmentFacts> facts);
    [[nodiscard]] const std::optional<SegmentFacts>& facts() const { return m_facts; }
    /// Where what it tells of is seen, in the viewport: it goes to the other side where it would lie on that.
    void keepClearOf(const QRectF& seen) { m_seen = seen; }
    /// In the viewport, where it rests; nothing where it does not. The card never lies under it.
    void setPointer(std::optional<QPoint> pointer) { m_pointer = pointer; }
    /// At the lower right, where mostly floor is, or at the lower left; it is not shown where it would cover
    /// most of the viewport.
    void place();

protected:
    void paintEvent(QPaintEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    /// At the lower edge, above the banner if that is in the way.
    [[nodiscard]] QRect cornerFor(const QSize& size, bool isLeft) const;
    void showFacts();

    const QWidget& m_banner;
    std::optional<SegmentFacts> m_facts;
    QLabel* m_segment = plainLabel(this);
    QWidget* m_mark = new QWidget(this); ///< where the mark is painted
    ElidedLabel* m_character = new ElidedLabel(Qt::AlignLeft | Qt::AlignVCenter, this);
    QLabel* m_source = plainLabel(this);
    QLabel* m_table;
    QRectF m_seen;
    std::optional<QPoint> m_pointer;
    bool m_isLeft = false;
};

} // namespace posewire::gui
