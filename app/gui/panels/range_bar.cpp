// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/range_bar.h"

#include "app/gui/models/text.h"
#include "app/gui/panels/cell_delegate.h"

#include <QHBoxLayout>
#include <QToolButton>

namespace posewire::gui {

RangeBar::RangeBar(model::SessionView& view, Commands& commands, QWidget* parent)
    : QWidget(parent), m_view(view), m_commands(commands), m_strip(new RangeStrip(view, commands, this)) {
    const int margin = CellDelegate::margin(fontMetrics());
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(margin, margin / 2, margin, margin / 2);
    row->setSpacing(margin / 2);
    row->addWidget(m_strip, 1);
    addButton(tr("10 s"), tr("Figures for the last ten seconds"), std::chrono::seconds(10));
    addButton(tr("1 min"), tr("Figures for the last minute"), std::chrono::seconds(60));
    addButton(tr("All"), tr("Figures for everything received"), log::Duration::zero());
}

void RangeBar::addButton(const QString& text, const QString& toolTip, log::Duration last) {
    auto* button = new QToolButton(this);
    button->setText(text);
    button->setToolTip(toolTip);
    button->setProperty("framed", true);
    button->setCheckable(true);
    button->setFocusPolicy(Qt::TabFocus);
    layout()->addWidget(button);
    m_buttons.push_back({button, last});
    connect(button, &QToolButton::clicked, this, [this, last] {
        m_commands.selectRange({last, std::nullopt});
        refresh();
    });
}

void RangeBar::refresh() {
    m_strip->refresh();
    const model::RangeChoice& choice = m_view.rangeChoice();
    for (const Button& each : m_buttons) {
        each.button->setChecked(!choice.fixed && choice.last == each.last);
    }
}

QString RangeBar::rangeText() const {
    const auto range = m_view.range();
    if (!range) {
        return {};
    }
    const QString length = duration(range->seconds());
    if (!m_view.rangeChoice().fixed) {
        return tr("last %1").arg(length);
    }
    return tr("%1 + %2").arg(timeOfDay(range->from).chopped(2), length);
}

} // namespace posewire::gui
