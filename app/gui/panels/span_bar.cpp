// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/span_bar.h"

#include "app/gui/panels/cell_delegate.h"
#include "app/gui/theme/widgets.h"

namespace posewire::gui {

SpanBar::SpanBar(model::SessionView& view, Commands& commands, QWidget* parent)
    : QWidget(parent), m_view(view), m_commands(commands) {
    static_cast<void>(spacedRow({}, CellDelegate::margin(fontMetrics()) / 2, this));
    add(tr("10 s"), tr("Figures of the last ten seconds"),
        model::RangeChoice{.last = std::chrono::seconds(10)});
    add(tr("1 min"), tr("Figures of the last minute"), model::RangeChoice{.last = std::chrono::seconds(60)});
    add(tr("Since reset"), tr("Figures since the reset before the take"),
        model::RangeChoice{.isSinceReset = true});
    add(tr("Selection"), tr("Figures of the range that was dragged in the strip; press to leave it"), {});
    add(tr("All"), tr("Figures of everything received"), model::RangeChoice{});
    refresh();
}

void SpanBar::add(const QString& text, const QString& toolTip,
                  const std::optional<model::RangeChoice>& choice) {
    QToolButton* button = framedButton(text, toolTip, this);
    button->setCheckable(true);
    button->setFocusPolicy(Qt::StrongFocus);
    layout()->addWidget(button);
    m_buttons.push_back({button, choice});
    connect(button, &QToolButton::clicked, this, [this, choice] {
        m_commands.selectRange(choice.value_or(model::RangeChoice{}));
        refresh();
    });
}

void SpanBar::refresh() {
    const model::RangeChoice& chosen = m_view.rangeChoice();
    for (const auto& [button, choice] : m_buttons) {
        const bool isDragged = !choice && chosen.fixed;
        const bool isThere = choice ? !choice->isSinceReset || m_view.reset() != log::Stamp() : isDragged;
        button->setChecked(isDragged || choice == std::optional(chosen));
        button->setVisible(isThere);
    }
}

} // namespace posewire::gui
