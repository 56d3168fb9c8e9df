// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/inspector_panel.h"

#include "app/gui/models/field_text.h"
#include "app/gui/models/packet_facts.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/theme.h"
#include "core/model/session/accounts.h"
#include "core/model/session/roster.h"

#include <QMenu>

namespace posewire::gui {

namespace {

constexpr int kDetailLines = 4;

/// Taken apart as what is known of its sender says.
std::shared_ptr<const FieldDocument> documentOf(model::SessionView& view, const log::Packet& packet) {
    const model::Sender* sender = view.roster().find(packet.sender);
    const model::PacketDigest* digest = view.accounts().digests().find(packet.number);
    if (sender == nullptr || digest == nullptr) {
        return std::make_shared<FieldDocument>(packet, model::LengthUnit::Metre);
    }
    return std::make_shared<FieldDocument>(packet, sender->positionUnit(digest->type),
                                           sender->isYUp(digest->type));
}

/// False once the sender is found to use another unit or axis than the document was read with.
bool isAsRead(model::SessionView& view, const FieldDocument& document) {
    const model::Sender* sender = view.roster().find(document.sender);
    return sender == nullptr || !document.hasHeader ||
           (document.unit == sender->positionUnit(document.type()) &&
            document.isYUp == sender->isYUp(document.type()));
}

/// Plain text in a colour, as rich text.
QString coloured(const QColor& colour, const QString& text) {
    return QStringLiteral("<span style=\"color:%1\">%2</span>").arg(colour.name(), text.toHtmlEscaped());
}

void setLines(QLabel& label, const QStringList& richLines) {
    label.setText(richLines.join(QStringLiteral("<br>")));
}

QStringList packetLines(const FieldDocument& document) {
    const QStringList facts = documentLines(document);
    QStringList lines{QStringLiteral("<b>%1</b>").arg(documentTitle(document).toHtmlEscaped()),
                      facts.value(0).toHtmlEscaped()};
    for (const QString& fact : facts.mid(1)) {
        lines += coloured(theme().dim, fact);
    }
    return lines;
}

ByteRange rangeOf(const FieldDocument& document, std::int32_t node) {
    if (node < 0) {
        return {};
    }
    const wire::FieldNode& field = document.node(node);
    return {field.offset, field.offset + field.length};
}

} // namespace

InspectorPanel::InspectorPanel(model::SessionView& view, Commands& commands, QWidget* parent)
    : Panel(view, commands, parent),
      m_hold(flatButton(tr("Hold"), tr("Keep showing this packet while the stream continues"), this)),
      m_compare(flatButton(tr("Compare ▾"), tr("Compare with another packet of the same type"), this)),
      m_problems(richLabel(this)),
      m_detail(richLabel(this)) {
    layOut();
    new EventWatch(this, QEvent::Resize, [this] {
        const bool isWide = width() > 2 * height() && width() > fontMetrics().averageCharWidth() * 100;
        m_splitter->setOrientation(isWide ? Qt::Horizontal : Qt::Vertical);
    });
    new EventWatch(this, QEvent::StyleChange, [this] {
        if (m_isShown) {
            describeProblems();
            describeCurrent();
        }
    });
    connect(m_fields, &FieldView::nodeEntered, this, &InspectorPanel::hover);
    connect(m_fields, &FieldView::nodeSelected, this, &InspectorPanel::select);
    connect(m_bytes, &ByteView::hovered, this, [this](std::int64_t offset) {
        hover(offset < 0 ? -1 : m_document->nodeAt(static_cast<std::uint32_t>(offset)));
    });
    connect(m_bytes, &ByteView::activated, this, &InspectorPanel::activate);
    connect(m_bytes, &ByteView::menuRequested, m_fields, &FieldView::showMenu);
    connect(m_problems, &QLabel::linkActivated, this, [this](const QString& link) {
        const auto index = link.toULongLong();
        if (index < m_document->problems.size()) {
            goTo(m_document->problems[index].node);
        }
    });
    connect(m_previous, &QToolButton::clicked, this, [this] { step(Direction::Backward); });
    connect(m_next, &QToolButton::clicked, this, [this] { step(Direction::Forward); });
    m_hold->setCheckable(true);
    m_hold->setAccessibleName(tr("Hold this packet"));
    connect(m_hold, &QToolButton::clicked, this, &InspectorPanel::toggleHold);
    m_compare->setMenu(new QMenu(m_compare));
    m_compare->setPopupMode(QToolButton::InstantPopup);
    connect(m_compare->menu(), &QMenu::aboutToShow, this, &InspectorPanel::fillCompareMenu);
    showParts();
    describeProblems();
}

void InspectorPanel::layOut() {
    const int margin = CellDelegate::margin(fontMetrics());
    auto* layout = tightColumn(this);
    auto* bar = spacedRow({margin, 2, margin, 2}, 2);
    bar->addWidget(m_title, 1);
    for (QToolButton* button : {m_previous, m_next, m_hold, m_compare}) {
        bar->addWidget(button);
    }
    layout->addLayout(bar);
    layout->addWidget(new Line(this));
    for (QLabel* label : {m_problems, m_detail}) {
        label->setWordWrap(true);
        label->setContentsMargins(margin, margin / 2, margin, margin / 2);
    }
    m_problems->setTextInteractionFlags(Qt::LinksAccessibleByMouse | Qt::LinksAccessibleByKeyboard);
    m_problems->setObjectName(QStringLiteral("problems"));
    m_problems->setAccessibleName(tr("What is wrong with the packet"));
    layout->addWidget(m_splitter, 1); // what is wrong comes below it: fields stay in their place
    layout->addWidget(m_problemLine);
    layout->addWidget(m_problems);
    m_splitter->addWidget(m_fields);
    m_splitter->addWidget(m_bytes);
    m_splitter->setStretchFactor(0, 3);
    m_splitter->setStretchFactor(1, 2);
    m_splitter->setHandleWidth(1);
    layout->addWidget(m_detailLine);
    m_detail->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    m_detail->setFixedHeight(fontMetrics().lineSpacing() * kDetailLines + margin);
    m_detail->setMinimumWidth(1);
    layout->addWidget(m_detail);
}

void InspectorPanel::refresh() {
    const auto wanted = inspectedPacket(m_view, m_type);
    const auto packet = wanted ? m_view.packet(*wanted) : std::nullopt;
    if (!packet) {
        return;
    }
    const bool isNew = !m_isShown || m_document->number != packet->number ||
                       m_document->sender != packet->sender || !isAsRead(m_view, *m_document);
    if (isNew) {
        inspect(*packet);
    }
    // Some of it is known only once later packets are there.
    if (QStringList sequence = sequenceFindings(m_view, packet->number); sequence != m_sequence) {
        m_sequence = std::move(sequence);
        describeProblems();
    }
    m_hold->setChecked(m_view.choices().selection.packet.has_value());
    followSelection(isNew);
}

void InspectorPanel::showParts() {
    if (!m_isShown) {
        m_title->setText({}, tr("No packet"));
        m_fields->setEmptyText(tr("No packet yet.\nEvery field and byte of the selected packet, or of the "
                                  "newest one, is shown here."));
    }
    for (QWidget* widget : std::initializer_list<QWidget*>{m_bytes, m_detail, m_detailLine}) {
        widget->setVisible(m_isShown);
    }
    for (QToolButton* button : {m_previous, m_next, m_hold, m_compare}) {
        button->setEnabled(m_isShown);
    }
}

void InspectorPanel::inspect(const log::Packet& packet) {
    m_document = documentOf(m_view, packet);
    m_sequence = sequenceFindings(m_view, packet.number);
    m_isShown = true;
    showParts();
    m_fields->change([this] {
        m_model.setDocument(m_document);
        showComparison();
    });
    m_bytes->setDocument(m_document);
    const int type = m_document->hasHeader ? m_document->type() : -1;
    if (m_openedType != type) {
        m_openedType = type;
        m_fields->openFirst();
    }
    if (m_document->hasHeader && m_document->kind == model::PacketKind::Datagram) {
        m_type = m_document->type();
    }
    QString owner;
    if (m_document->hasHeader) {
        const model::CharacterKey key{packet.sender, m_document->header.character};
        owner = QStringLiteral(" · ") + characterName(m_view, key);
    }
    m_title->setText(documentTitle(*m_document), owner);
    m_title->setToolTip(toolTipText(
        tr("Packet %1, received at %2").arg(grouped(packet.number), timeOfDay(m_view.wallOf(packet.stamp)))));
    describeProblems();
    describeCurrent();
}

void InspectorPanel::showComparison() {
    std::shared_ptr<const FieldDocument> other;
    std::optional<std::uint64_t> number;
    if (m_comparison == Comparison::Previous) {
        number = comparableBefore(m_view, m_document->number);
    } else if (m_comparison == Comparison::Reference) {
        number = m_reference;
    }
    if (const auto packet = number ? m_view.packet(*number) : std::nullopt) {
        other = documentOf(m_view, *packet);
    }
    const bool isSameType =
        other != nullptr && other->hasHeader && m_document->hasHeader && other->type() == m_document->type();
    if (isSameType || m_model.other() != nullptr) {
        m_model.setOther(isSameType ? other : nullptr);
    }
    m_bytes->setOther(isSameType ? other : nullptr);
    m_compare->setText(m_comparison == Comparison::None ? tr("Compare ▾") : tr("Comparing ▾"));
    m_fields->setEmptyText(tr("No field differs."));
}

void InspectorPanel::compare(Comparison comparison) {
    m_comparison = comparison;
    if (!m_isShown) {
        return;
    }
    if (comparison != Comparison::None && !m_view.choices().selection.packet) {
        m_commands.selectPacket(m_document->number);
    }
    m_fields->change([this] { showComparison(); });
    describeProblems();
}

void InspectorPanel::setReference() {
    if (m_isShown) {
        m_reference = m_document->number;
    }
}

QString InspectorPanel::comparisonText() const {
    if (m_comparison == Comparison::None) {
        return {};
    }
    if (const FieldDocument* other = m_model.other()) {
        const QString count = tr("%n fields differ", nullptr, static_cast<int>(m_model.differences()));
        const double apartMs = log::millisecondsOf(m_document->stamp - other->stamp);
        return tr("Compared with packet %1, %2 ms apart: %3")
            .arg(grouped(other->number), signedFixed(apartMs, 2), count);
    }
    return m_comparison == Comparison::Previous
               ? tr("No earlier packet of this stream to compare with")
               : tr("The reference is of another type or no longer in the history: only packets of one type "
                    "can be compared");
}

void InspectorPanel::describeProblems() {
    QStringList lines;
    for (std::size_t i = 0; i < m_document->problems.size(); ++i) {
        const FieldProblem& problem = m_document->problems[i];
        if (problem.text.isEmpty()) {
            continue;
        }
        const bool isRemark = problem.level == Health::Unknown;
        const QString text = isRemark ? problem.text : healthText(problem.level, problem.text);
        lines += QStringLiteral("<a href=\"%1\" style=\"color:%2; text-decoration:none\">%3</a>")
                     .arg(i)
                     .arg(healthColour(problem.level).name(), text.toHtmlEscaped());
    }
    for (const QString& text : m_sequence) {
        lines += coloured(theme().warning, healthText(Health::Warning, text));
    }
    if (const QString comparison = comparisonText(); !comparison.isEmpty()) {
        lines += coloured(theme().dim, comparison);
    }
    setLines(*m_problems, lines);
    m_problems->setVisible(!lines.isEmpty());
    m_problemLine->setVisible(!lines.isEmpty());
}

void InspectorPanel::describe(std::int32_t node) {
    if (node < 0 || node >= m_document->count()) {
        setLines(*m_detail, m_isShown ? packetLines(*m_document) : QStringList());
        return;
    }
    const std::int32_t item = m_document->itemOf(node);
    QString title = QStringLiteral("<b>%1</b>").arg(fieldTitle(*m_document, node).toHtmlEscaped());
    if (item >= 0 && item != node) {
        title += coloured(theme().dim, tr(" of %1").arg(fieldTitle(*m_document, item)));
    }
    const QString wire = wireValue(*m_document, node);
    const QString value = convertedValue(*m_document, node);
    QStringList lines{title};
    lines +=
        (wire.isEmpty() || wire == value
             ? value.left(200).toHtmlEscaped()
             : tr("%1 <span style=\"color:%3\">on the wire, means</span> %2")
                   .arg(wire.left(200).toHtmlEscaped(), value.left(200).toHtmlEscaped(), theme().dim.name()));
    QStringList about{fieldPlace(*m_document, node), fieldMeaning(*m_document, node),
                      fieldSection(*m_document, node)};
    about.removeAll(QString());
    lines += coloured(theme().dim, about.join(QStringLiteral(" · ")));
    setLines(*m_detail, lines);
}

void InspectorPanel::describeCurrent() {
    const std::int32_t node = m_fields->currentNode();
    m_bytes->setSelected(rangeOf(*m_document, node));
    describe(node);
}

void InspectorPanel::followSelection(bool isNewPacket) {
    const model::Selection& selection = m_view.choices().selection;
    const bool isOtherSegment = selection.segment != m_followed.segment;
    const bool isOtherPacket = selection.packet != m_followed.packet && selection.packet;
    const bool isFound = selection.found && selection.packet == selection.found->packet &&
                         (isNewPacket || selection.found != m_followed.found);
    m_followed = selection;
    if (isFound) {
        // The field that they begin in, and all of them.
        const ByteRange found{selection.found->begin, selection.found->end};
        goTo(m_document->nodeAt(found.begin));
        m_bytes->setSelected(found);
        m_bytes->scrollTo(found.begin);
        return;
    }
    if (isOtherPacket && isNewPacket) {
        const auto& problems = m_document->problems;
        const auto first = std::ranges::find_if(problems, [](const FieldProblem& problem) {
            return problem.node >= 0 && problem.level != Health::Unknown;
        });
        if (first != problems.end()) {
            goTo(first->node);
            return;
        }
    }
    if (isOtherSegment && selection.segment >= 0 &&
        m_document->segmentOf(m_fields->currentNode()) != selection.segment) {
        goTo(m_document->nodeOfSegment(selection.segment));
    }
}

void InspectorPanel::hover(std::int32_t node) {
    m_bytes->setHovered(rangeOf(*m_document, node));
    m_fields->setHovered(node);
    describe(node >= 0 ? node : m_fields->currentNode());
}

void InspectorPanel::select(std::int32_t node) {
    const ByteRange range = rangeOf(*m_document, node);
    m_bytes->setSelected(range);
    m_bytes->scrollTo(range.begin);
    describe(node);
    const int segment = m_document->segmentOf(node);
    if (segment >= 0 && m_document->hasHeader && segment != m_view.choices().selection.segment) {
        model::Selection selection = m_view.choices().selection;
        selection.sender = m_document->sender;
        selection.character = model::CharacterKey{m_document->sender, m_document->header.character};
        selection.segment = segment;
        m_followed = selection;
        m_commands.select(selection);
    }
}

void InspectorPanel::activate(std::int64_t offset) {
    const std::int32_t node = m_document->nodeAt(static_cast<std::uint32_t>(offset));
    if (node >= 0) {
        m_fields->setCurrentNode(node);
        select(node);
    }
}

void InspectorPanel::goTo(std::int32_t node) {
    if (node < 0) {
        return;
    }
    m_fields->setCurrentNode(node);
    // Not shown if only differences are, and it has none: its bytes are there all the same.
    if (const QModelIndex index = m_model.indexOf(node); index.isValid()) {
        m_fields->expand(index);
        m_fields->scrollTo(index, m_document->itemOf(node) == node ? QAbstractItemView::PositionAtTop
                                                                   : QAbstractItemView::PositionAtCenter);
    }
    describeCurrent();
    m_bytes->scrollTo(rangeOf(*m_document, node).begin);
}

void InspectorPanel::step(Direction direction) {
    if (const auto found =
            m_isShown ? neighbourInStream(m_view, m_document->number, direction) : std::nullopt) {
        m_commands.selectPacket(*found);
    }
}

void InspectorPanel::toggleHold() {
    if (isHeld()) {
        m_commands.unselectPacket();
    } else if (m_isShown) {
        m_commands.selectPacket(m_document->number);
    }
}

QString InspectorPanel::summary() const {
    if (!m_isShown) {
        return {};
    }
    const QString number = tr("packet %1").arg(grouped(m_document->number));
    const bool isPaused = m_view.choices().cursor.mode == model::Cursor::Mode::Paused;
    return isPaused || m_view.choices().selection.packet ? number : tr("following · %1").arg(number);
}

/// A part of the panel, so that its entries reach what is private there.
struct InspectorPanel::Actions {
    using Do = ActionsOf<InspectorPanel>;

    static constexpr const char* kGoMenu = "&Go";
    static constexpr const char* kComparePacket = QT_TRANSLATE_NOOP("Action", "&Edit/Compar&e packet");

    static constexpr ActionInfo kTable[] = {
        {"holdPacket", kGoMenu, QT_TRANSLATE_NOOP("Action", "&Hold this packet"), "",
         Do::call<&InspectorPanel::toggleHold>, Do::is<&InspectorPanel::isHeld>},
        {"compareNot", kComparePacket, QT_TRANSLATE_NOOP("Action", "Do &not compare"), "",
         Do::call<&InspectorPanel::compare, Comparison::None>,
         Do::is<&InspectorPanel::comparison, Comparison::None>},
        {"comparePrevious", kComparePacket,
         QT_TRANSLATE_NOOP("Action", "With the &previous packet of its stream"), "",
         Do::call<&InspectorPanel::compare, Comparison::Previous>,
         Do::is<&InspectorPanel::comparison, Comparison::Previous>},
        {"compareReference", kComparePacket, QT_TRANSLATE_NOOP("Action", "With the &reference"), "",
         Do::call<&InspectorPanel::compare, Comparison::Reference>,
         Do::is<&InspectorPanel::comparison, Comparison::Reference>},
        lineIn(kComparePacket),
        {"setReference", kComparePacket, QT_TRANSLATE_NOOP("Action", "&Set this packet as reference"), "",
         Do::call<&InspectorPanel::setReference>},
        {"onlyDifferences", kComparePacket, QT_TRANSLATE_NOOP("Action", "Only &differences"), "",
         Do::call<&InspectorPanel::toggleOnlyDifferences>,
         Do::isIn<&InspectorPanel::m_model, &FieldModel::isOnlyDifferences>},
    };
};

std::span<const ActionInfo> InspectorPanel::actionTable() {
    return Actions::kTable;
}

void InspectorPanel::fillCompareMenu() {
    QMenu* menu = m_compare->menu();
    menu->clear();
    const auto add = [&](const QString& text, Comparison comparison) {
        QAction* action = menu->addAction(text, this, [this, comparison] { compare(comparison); });
        action->setCheckable(true);
        action->setChecked(m_comparison == comparison);
        return action;
    };
    add(tr("Do not compare"), Comparison::None);
    add(tr("With the previous packet of its stream"), Comparison::Previous);
    add(m_reference ? tr("With the reference, packet %1").arg(grouped(*m_reference))
                    : tr("With the reference"),
        Comparison::Reference)
        ->setEnabled(m_reference.has_value());
    menu->addSeparator();
    menu->addAction(tr("Set this packet as reference"), this, &InspectorPanel::setReference);
    QAction* only = menu->addAction(tr("Only differences"));
    only->setCheckable(true);
    only->setChecked(m_model.isOnlyDifferences());
    connect(only, &QAction::triggered, this, &InspectorPanel::toggleOnlyDifferences);
}

void InspectorPanel::toggleOnlyDifferences() {
    m_fields->change([this] { m_model.setOnlyDifferences(!m_model.isOnlyDifferences()); });
}

} // namespace posewire::gui
