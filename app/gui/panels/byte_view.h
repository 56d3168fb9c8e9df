// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/field_document.h"

#include <QAbstractScrollArea>
#include <QMouseEvent>

#include <memory>

namespace posewire::gui {

/// Bytes from `begin` to before `end`.
struct ByteRange {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;

    [[nodiscard]] bool contains(std::uint32_t offset) const { return offset >= begin && offset < end; }
    friend bool operator==(const ByteRange&, const ByteRange&) = default;
};

/// The bytes of a packet in hexadecimal and as characters, as many in a row as there is room for. What is
/// wrong is boxed or underlined, what belongs to no field is dim.
class ByteView : public QAbstractScrollArea {
    Q_OBJECT

public:
    explicit ByteView(QWidget* parent = nullptr);

    /// Not null.
    void setDocument(std::shared_ptr<const FieldDocument> document);
    /// The bytes that are compared with; those that differ are marked. Null for none.
    void setOther(std::shared_ptr<const FieldDocument> other);
    void setSelected(const ByteRange& range);
    void setHovered(const ByteRange& range);
    void scrollTo(std::uint32_t offset);

    [[nodiscard]] const ByteRange& selected() const { return m_selected; }
    [[nodiscard]] QSize sizeHint() const override {
        return {static_cast<int>(m_advance * 40), rowHeight() * 8};
    }

    /// Middle of the hexadecimal digits of a byte, in the viewport.
    [[nodiscard]] QPoint centreOf(std::uint32_t offset) const { return hexCell(offset).center().toPoint(); }
    /// The byte under a point of the viewport; -1 for none.
    [[nodiscard]] std::int64_t byteAt(const QPoint& point) const;

signals:
    /// -1 where the pointer is on no byte.
    void hovered(std::int64_t offset);
    void activated(std::uint32_t offset);
    void menuRequested(const QPoint& globalPosition);

protected:
    void paintEvent(QPaintEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override { emit hovered(byteAt(event->position().toPoint())); }
    void mousePressEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;
    bool viewportEvent(QEvent* event) override;

private:
    void fit();
    void markBytes();
    void paintRow(QPainter& painter, std::uint32_t row);
    void paintByte(QPainter& painter, std::uint32_t offset);
    void paintMarks(QPainter& painter, std::uint32_t offset, const QRectF& cell) const;
    [[nodiscard]] QRectF hexCell(std::uint32_t offset) const;
    [[nodiscard]] QRectF textCell(std::uint32_t offset) const;
    [[nodiscard]] int rowHeight() const { return QFontMetrics(monospaceFont()).height() + 4; }
    [[nodiscard]] double columnLeft(int column) const;
    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(m_document->bytes.size()); }

    std::shared_ptr<const FieldDocument> m_document = std::make_shared<FieldDocument>();
    std::shared_ptr<const FieldDocument> m_other;
    std::vector<Health> m_health; ///< of each byte
    std::vector<bool> m_isUnread;
    ByteRange m_selected;
    ByteRange m_hovered;
    std::uint32_t m_current = 0;
    int m_perRow = 8;
    bool m_hasText = true;
    double m_advance = 8; ///< of one character
    double m_margin = 8;
};

} // namespace posewire::gui
