// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/panel.h"
#include "app/gui/models/field_model.h"
#include "app/gui/models/packet_choice.h"
#include "app/gui/panels/byte_view.h"
#include "app/gui/panels/field_view.h"
#include "app/gui/theme/widgets.h"

#include <QSplitter>
#include <Qt>

#include <memory>
#include <optional>

namespace posewire::gui {

/// Dock `inspector`: every field and byte of the selected packet, or of the newest one of the shown
/// character, what is wrong with it at the bytes where it arose, and two packets of a type side by side.
class InspectorPanel : public Panel {
    Q_OBJECT

public:
    InspectorPanel(model::SessionView& view, Commands& commands, QWidget* parent);

    [[nodiscard]] static std::span<const ActionInfo> actionTable();

    void refresh() override;
    [[nodiscard]] QString summary() const override;

    enum class Comparison { None, Previous, Reference };
    void compare(Comparison comparison);
    [[nodiscard]] Comparison comparison() const { return m_comparison; }
    void setReference();
    /// Keeps showing the packet that is shown, or follows the stream again.
    void toggleHold();
    [[nodiscard]] bool isHeld() const { return m_view.choices().selection.packet.has_value(); }

private:
    struct Actions;

    void layOut();
    void fillCompareMenu();

    void inspect(const log::Packet& packet);
    void showComparison();
    [[nodiscard]] QString comparisonText() const;
    void describeProblems();
    void describe(std::int32_t node);
    void describeCurrent();
    void followSelection(bool isNewPacket);
    /// Without a packet there is nothing but what is said about that.
    void showParts();
    void toggleOnlyDifferences();

    void hover(std::int32_t node);
    void select(std::int32_t node);
    void activate(std::int64_t offset);
    void goTo(std::int32_t node);
    void step(Direction direction);

    FieldModel m_model;
    std::shared_ptr<const FieldDocument> m_document = std::make_shared<FieldDocument>();
    std::optional<std::uint64_t> m_reference;
    Comparison m_comparison = Comparison::None;
    std::uint8_t m_type = 0;         ///< of the newest packet shown: its stream is kept to
    std::optional<int> m_openedType; ///< whose lists have been opened
    model::Selection m_followed;
    QStringList m_sequence; ///< what is odd about the packet's place in its stream
    bool m_isShown = false;

    ElidedLabel* m_title = new ElidedLabel(Qt::AlignLeft, this);
    QToolButton* m_previous = flatButton(QStringLiteral("‹"), tr("Previous packet of this stream"), this);
    QToolButton* m_next = flatButton(QStringLiteral("›"), tr("Next packet of this stream"), this);
    QToolButton* m_hold;
    QToolButton* m_compare;
    QLabel* m_problems;
    Line* m_problemLine = new Line(this);
    QSplitter* m_splitter = new QSplitter(Qt::Vertical, this);
    FieldView* m_fields = new FieldView(m_model, m_commands, this);
    ByteView* m_bytes = new ByteView(this);
    QLabel* m_detail;
    Line* m_detailLine = new Line(this);
};

} // namespace posewire::gui
