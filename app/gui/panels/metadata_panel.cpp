// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/metadata_panel.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/theme/theme.h"
#include "core/model/session/roster.h"

#include <QActionGroup>
#include <QMenu>

#include <optional>

namespace posewire::gui {

namespace {

using model::LengthUnit;
using model::Revision;
using model::SenderOverride;
using model::UpAxis;

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

/// As it was detected.
constexpr std::nullopt_t kAutomatic = std::nullopt;

template <auto member, auto value>
void declare(MetadataPanel& panel) {
    SenderOverride overrides = panel.detection().declared();
    overrides.*member = value;
    panel.detection().declare(overrides);
}

template <auto member, auto value>
bool isDeclared(const MetadataPanel& panel) {
    return panel.detection().declared().*member == value;
}

template <auto member, auto value>
constexpr ActionInfo entry(const char* id, const char* menu, const char* text) {
    using Do = ActionsOf<MetadataPanel>;
    return {id, menu, text, "", Do::call<declare<member, value>>, Do::is<isDeclared<member, value>>};
}

constexpr auto kRevision = &SenderOverride::revision;
constexpr auto kUnit = &SenderOverride::positionUnit;
constexpr auto kUp = &SenderOverride::up;
constexpr const char* kRevisions = QT_TRANSLATE_NOOP("Action", "&Input/&Revision of the sender");
constexpr const char* kUnits = QT_TRANSLATE_NOOP("Action", "&Input/&Units of positions");

constexpr const char* kUps = QT_TRANSLATE_NOOP("Action", "&Input/U&p axis of the sender");

constexpr ActionInfo kMetadataActions[] = {
    entry<kRevision, kAutomatic>("revisionAutomatic", kRevisions, QT_TRANSLATE_NOOP("Action", "&Automatic")),
    entry<kRevision, Revision::E>("revisionE", kRevisions, QT_TRANSLATE_NOOP("Action", "&E")),
    entry<kRevision, Revision::JOrK>("revisionJ", kRevisions, QT_TRANSLATE_NOOP("Action", "&J or K")),
    entry<kRevision, Revision::N>("revisionN", kRevisions, QT_TRANSLATE_NOOP("Action", "&L to N")),
    entry<kUnit, kAutomatic>("unitsAutomatic", kUnits, QT_TRANSLATE_NOOP("Action", "&Automatic")),
    entry<kUnit, LengthUnit::Metre>("unitsMetres", kUnits, QT_TRANSLATE_NOOP("Action", "&Metres")),
    entry<kUnit, LengthUnit::Centimetre>("unitsCentimetres", kUnits,
                                         QT_TRANSLATE_NOOP("Action", "&Centimetres")),
    entry<kUnit, LengthUnit::Millimetre>("unitsMillimetres", kUnits,
                                         QT_TRANSLATE_NOOP("Action", "M&illimetres")),
    entry<kUp, kAutomatic>("upAutomatic", kUps, QT_TRANSLATE_NOOP("Action", "&Automatic")),
    entry<kUp, UpAxis::Z>("upZ", kUps, QT_TRANSLATE_NOOP("Action", "&Z-up")),
    entry<kUp, UpAxis::Y>("upY", kUps, QT_TRANSLATE_NOOP("Action", "&Y-up")),
};

} // namespace

DetectionBar::DetectionBar(model::SessionView& view, Commands& commands, QWidget* parent)
    : QWidget(parent),
      m_view(view),
      m_commands(commands),
      m_revision(addChoice<Revision>(tr("Protocol revision assumed for this sender"),
                                     &SenderOverride::revision,
                                     {{tr("automatic"), std::nullopt},
                                      {tr("E"), Revision::E},
                                      {tr("J or K"), Revision::JOrK},
                                      {tr("L to N"), Revision::N}})),
      m_unit(addChoice<LengthUnit>(tr("Unit assumed for positions of types 02, 05, 21 and 24"),
                                   &SenderOverride::positionUnit,
                                   {{tr("automatic"), std::nullopt},
                                    {tr("metres"), LengthUnit::Metre},
                                    {tr("centimetres"), LengthUnit::Centimetre},
                                    {tr("millimetres"), LengthUnit::Millimetre}})),
      m_up(addChoice<UpAxis>(
          tr("Axis assumed to be up in types 02, 21 and 22"), &SenderOverride::up,
          {{tr("automatic"), std::nullopt}, {tr("Z-up"), UpAxis::Z}, {tr("Y-up"), UpAxis::Y}})) {
    const int margin = CellDelegate::margin(fontMetrics());
    m_contradictions->setWordWrap(true);
    m_contradictions->setContentsMargins(margin, margin / 2, margin, 0);
    m_contradictions->setTextInteractionFlags(Qt::TextSelectableByMouse);
    auto* row = spacedRow({margin, margin, margin, margin}, margin);
    row->addWidget(m_revision.button);
    row->addWidget(m_unit.button);
    row->addWidget(m_up.button);
    row->addStretch(1);
    auto* column = tightColumn(this);
    column->addWidget(new Line(this));
    column->addWidget(m_contradictions);
    column->addLayout(row);
    hide();
}

template <class Value>
DetectionBar::Choice
DetectionBar::addChoice(const QString& toolTip, std::optional<Value> SenderOverride::*declared,
                        const std::vector<std::pair<QString, std::optional<Value>>>& values) {
    const Choice choice{framedButton({}, toolTip, this), new QActionGroup(this)};
    auto* menu = new QMenu(choice.button);
    choice.button->setPopupMode(QToolButton::InstantPopup);
    choice.button->setMenu(menu);
    for (const auto& [text, value] : values) {
        QAction* action = choice.group->addAction(menu->addAction(text));
        action->setCheckable(true);
        action->setData(value ? QVariant(static_cast<int>(*value)) : QVariant());
        connect(action, &QAction::triggered, this, [this, value = value, declared] {
            SenderOverride overrides = this->declared();
            overrides.*declared = value;
            declare(overrides);
        });
    }
    return choice;
}

SenderOverride DetectionBar::declared() const {
    const model::Sender* sender = m_sender ? m_view.roster().find(*m_sender) : nullptr;
    return sender == nullptr ? SenderOverride() : sender->overrides;
}

void DetectionBar::declare(const SenderOverride& overrides) {
    if (m_sender && m_view.roster().find(*m_sender) != nullptr) {
        m_commands.setOverride(*m_sender, overrides);
    }
}

void DetectionBar::showSender(std::optional<log::SenderId> sender) {
    m_sender = sender;
    const model::Sender* found = sender ? m_view.roster().find(*sender) : nullptr;
    setVisible(found != nullptr);
    if (found == nullptr) {
        return;
    }
    const QString revision = check(*m_revision.group, found->overrides.revision);
    const QString unit = check(*m_unit.group, found->overrides.positionUnit);
    m_revision.button->setText(tr("Revision: %1 ▾").arg(revision));
    m_unit.button->setText(tr("Units: %1 ▾").arg(unit));
    m_up.button->setText(tr("Up: %1 ▾").arg(check(*m_up.group, found->overrides.up)));
    showContradictions(*found);
}

void DetectionBar::showContradictions(const model::Sender& sender) {
    QStringList lines;
    for (const words::Fact& one : sender.contradictions()) {
        lines += healthText(Health::Warning, said(one, words::Form::Sentence));
    }
    m_contradictions->setVisible(!lines.isEmpty());
    const QString text = lines.join(QLatin1Char('\n'));
    if (text != m_contradictions->text()) {
        m_contradictions->setText(text);
        setTextColour(*m_contradictions, healthColour(Health::Warning));
    }
}

MetadataPanel::MetadataPanel(model::SessionView& view, Commands& commands, QWidget* parent)
    : Panel(view, commands, parent) {
    auto* layout = tightColumn(this);
    layout->addWidget(m_table, 1);
    layout->addWidget(m_detection);
    m_table->setModel(&m_model);
    m_table->setRootIsDecorated(true);
    m_table->setEmptyText(
        tr("No character selected.\nMetadata (type 12) appears here as soon as a character arrives."));
}

std::span<const ActionInfo> MetadataPanel::actionTable() {
    return kMetadataActions;
}

void MetadataPanel::refresh() {
    m_model.refresh();
    const auto key = shownCharacter(m_view);
    m_detection->showSender(key ? std::optional(key->sender) : std::nullopt);
}

QString MetadataPanel::summary() const {
    const auto key = shownCharacter(m_view);
    return key ? nameApart(m_view, *key) : QString();
}

} // namespace posewire::gui
