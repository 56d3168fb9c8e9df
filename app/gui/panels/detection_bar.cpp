// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/detection_bar.h"

#include "app/gui/panels/cell_delegate.h"
#include "app/gui/panels/line.h"
#include "app/gui/theme/theme.h"

#include <QActionGroup>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QVBoxLayout>

namespace posewire::gui {

namespace {

using model::LengthUnit;
using model::Revision;

/// Checks what is declared and returns its text, a short one where nothing is.
template <class Value>
QString check(const QActionGroup& group, const std::optional<Value>& declared) {
    QString text = DetectionBar::tr("auto");
    const auto actions = group.actions();
    for (QAction* action : actions) {
        const auto value = action->data().isValid()
                               ? std::optional(static_cast<Value>(action->data().toInt()))
                               : std::nullopt;
        action->setChecked(value == declared);
        if (declared && value == declared) {
            text = action->text();
        }
    }
    return text;
}

} // namespace

DetectionBar::DetectionBar(model::SessionView& view, Commands& commands, QWidget* parent)
    : QWidget(parent),
      m_view(view),
      m_commands(commands),
      m_contradictions(new QLabel(this)),
      m_revision(addButton(tr("Protocol revision assumed for this sender"), m_revisions)),
      m_unit(addButton(tr("Unit assumed for positions of types 02 and 05"), m_units)) {
    const int margin = CellDelegate::margin(fontMetrics());
    m_contradictions->setWordWrap(true);
    m_contradictions->setContentsMargins(margin, margin / 2, margin, 0);
    m_contradictions->setTextInteractionFlags(Qt::TextSelectableByMouse);
    auto* row = new QHBoxLayout;
    row->setContentsMargins(margin, margin, margin, margin);
    row->setSpacing(margin);
    row->addWidget(m_revision);
    row->addWidget(m_unit);
    row->addStretch(1);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins({});
    column->setSpacing(0);
    column->addWidget(new Line(this));
    column->addWidget(m_contradictions);
    column->addLayout(row);

    addRevision(tr("automatic"), std::nullopt);
    addRevision(tr("E"), Revision::E);
    addRevision(tr("J or K"), Revision::JOrK);
    addRevision(tr("L to N"), Revision::N);
    addUnit(tr("automatic"), std::nullopt);
    addUnit(tr("metres"), LengthUnit::Metre);
    addUnit(tr("centimetres"), LengthUnit::Centimetre);
    hide();
}

QToolButton* DetectionBar::addButton(const QString& toolTip, QActionGroup*& group) {
    auto* button = new QToolButton(this);
    button->setProperty("framed", true);
    button->setFocusPolicy(Qt::TabFocus);
    button->setPopupMode(QToolButton::InstantPopup);
    button->setToolTip(toolTip);
    button->setMenu(new QMenu(button));
    group = new QActionGroup(this);
    return button;
}

void DetectionBar::addRevision(const QString& text, std::optional<Revision> revision) {
    QAction* action = m_revision->menu()->addAction(text);
    action->setCheckable(true);
    action->setData(revision ? QVariant(static_cast<int>(*revision)) : QVariant());
    m_revisions->addAction(action);
    connect(action, &QAction::triggered, this,
            [this, revision] { declare([&](model::SenderOverride& said) { said.revision = revision; }); });
}

void DetectionBar::addUnit(const QString& text, std::optional<LengthUnit> unit) {
    QAction* action = m_unit->menu()->addAction(text);
    action->setCheckable(true);
    action->setData(unit ? QVariant(static_cast<int>(*unit)) : QVariant());
    m_units->addAction(action);
    connect(action, &QAction::triggered, this,
            [this, unit] { declare([&](model::SenderOverride& said) { said.positionUnit = unit; }); });
}

void DetectionBar::declare(const std::function<void(model::SenderOverride&)>& change) {
    const model::Sender* sender = m_sender ? m_view.find(*m_sender) : nullptr;
    if (sender == nullptr) {
        return;
    }
    model::SenderOverride overrides = sender->overrides;
    change(overrides);
    m_commands.setOverride(*m_sender, overrides);
}

void DetectionBar::showSender(std::optional<log::SenderId> sender) {
    m_sender = sender;
    const model::Sender* found = sender ? m_view.find(*sender) : nullptr;
    setVisible(found != nullptr);
    if (found == nullptr) {
        return;
    }
    const QString revision = check(*m_revisions, found->overrides.revision);
    const QString unit = check(*m_units, found->overrides.positionUnit);
    m_revision->setText(tr("Revision: %1").arg(revision) + QStringLiteral(" ▾"));
    m_unit->setText(tr("Units: %1").arg(unit) + QStringLiteral(" ▾"));
    showContradictions(*found);
}

void DetectionBar::showContradictions(const model::Sender& sender) {
    QStringList lines;
    for (const model::Contradiction& one : sender.contradictions()) {
        lines += healthSymbol(Health::Warning) + QLatin1Char(' ') + QString::fromStdString(one.text);
    }
    m_contradictions->setVisible(!lines.isEmpty());
    const QString text = lines.join(QLatin1Char('\n'));
    if (text == m_contradictions->text()) {
        return;
    }
    m_contradictions->setText(text);
    QPalette palette = m_contradictions->palette();
    palette.setColor(QPalette::WindowText, healthColour(Health::Warning));
    m_contradictions->setPalette(palette);
}

} // namespace posewire::gui
