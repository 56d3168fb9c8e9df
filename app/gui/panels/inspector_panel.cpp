// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/inspector_panel.h"

#include "app/gui/models/field_text.h"
#include "app/gui/models/packet_choice.h"
#include "app/gui/models/packet_facts.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/theme/plain_text.h"
#include "app/gui/theme/widgets.h"
#include "core/model/session/accounts.h"
#include "core/model/session/roster.h"

#include <QMenu>

namespace posewire::gui {

namespace {

constexpr int kDetailLines = 4;

model::LengthUnit unitOf(model::SessionView& view, const log::Packet& packet) {
    const model::Sender* sender = view.roster().find(packet.sender);
    const model::PacketDigest* digest = view.accounts().digests().find(packet.number);
    return sender == nullptr || digest == nullptr ? model::LengthUnit::Metre
                                                  : sender->positionUnit(digest->type);
}

/// Plain text in a colour, as rich text.
QString coloured(const QColor& colour, const QString& text) {
    return QStringLiteral("<span style=\"color:%1\">%2</span>").arg(colour.name(), text.toHtmlEscaped());
}

void setLines(QLabel& label, const QStringList& richLines) {
    label.setText(richLines.join(QStringLiteral("<br>")));
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
      m_title(new ElidedLabel(Qt::AlignLeft, this)),
      m_previous(flatButton(QStringLiteral("‹"), tr("Previous packet of this stream"), this)),
      m_next(flatButton(QStringLiteral("›"), tr("Next packet of this stream"), this)),
      m_hold(flatButton(tr("Hold"), tr("Keep showing this packet while the stream continues"), this)),
      m_compare(flatButton(tr("Compare ▾"), tr("Compare with another packet of the same type"), this)),
      m_problems(richLabel(this)),
      m_problemLine(new Line(this)),
      m_splitter(new QSplitter(Qt::Vertical, this)),
      m_fields(new FieldView(m_model, commands, this)),
      m_bytes(new ByteView(this)),
      m_detail(richLabel(this)),
      m_detailLine(new Line(this)) {
    layOut();
    connectParts();
    showEmpty();
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
    m_problems->setAccessibleName(tr("What is wrong with the packet"));
    layout->addWidget(m_problems);
    layout->addWidget(m_problemLine);
    layout->addWidget(m_splitter, 1);
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

void InspectorPanel::connectParts() {
    connect(m_fields, &FieldView::nodeEntered, this, &InspectorPanel::hover);
    connect(m_fields, &FieldView::nodeSelected, this, &InspectorPanel::select);
    connect(m_fields, &FieldView::menuRequested, this, &InspectorPanel::openMenu);
    connect(m_bytes, &ByteView::hovered, this, [this](std::int64_t offset) {
        hover(offset < 0 ? -1 : m_document->nodeAt(static_cast<std::uint32_t>(offset)));
    });
    connect(m_bytes, &ByteView::activated, this, &InspectorPanel::activate);
    connect(m_bytes, &ByteView::menuRequested, this, &InspectorPanel::openMenu);
    connect(m_problems, &QLabel::linkActivated, this, [this](const QString& link) {
        const auto index = link.toULongLong();
        if (index < m_document->problems().size()) {
            goTo(m_document->problems()[index].node);
        }
    });
    connect(m_previous, &QToolButton::clicked, this, [this] { step(-1); });
    connect(m_next, &QToolButton::clicked, this, [this] { step(1); });
    m_hold->setCheckable(true);
    m_hold->setAccessibleName(tr("Hold this packet"));
    connect(m_hold, &QToolButton::clicked, this, &InspectorPanel::hold);
    m_compare->setMenu(new QMenu(m_compare));
    m_compare->setPopupMode(QToolButton::InstantPopup);
    connect(m_compare->menu(), &QMenu::aboutToShow, this, &InspectorPanel::fillCompareMenu);
}

void InspectorPanel::refresh() {
    const auto wanted = inspectedPacket(m_view, m_type);
    const auto packet = wanted ? m_view.packet(*wanted) : std::nullopt;
    if (!packet) {
        if (!wanted) {
            showEmpty();
        }
        return;
    }
    const bool isNew = !m_isShown || m_document->number() != packet->number ||
                       m_document->sender() != packet->sender ||
                       m_document->unit() != unitOf(m_view, *packet);
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

void InspectorPanel::showEmpty() {
    if (!m_isShown) {
        m_title->setText({}, tr("No packet"));
        m_fields->setEmptyText(tr("No packet yet.\nEvery field and byte of the selected packet, or of the "
                                  "newest one, is shown here."));
        m_problems->hide();
        m_problemLine->hide();
        m_detail->clear();
    }
    showParts();
}

/// Without a packet there is nothing but what is said about that.
void InspectorPanel::showParts() {
    m_bytes->setVisible(m_isShown);
    m_detail->setVisible(m_isShown);
    m_detailLine->setVisible(m_isShown);
    for (QToolButton* button : {m_previous, m_next, m_hold, m_compare}) {
        button->setEnabled(m_isShown);
    }
}

void InspectorPanel::inspect(const log::Packet& packet) {
    m_document = std::make_shared<FieldDocument>(packet, unitOf(m_view, packet));
    m_sequence = sequenceFindings(m_view, packet.number);
    m_isShown = true;
    showParts();
    m_fields->change([this] {
        m_model.setDocument(m_document);
        showComparison();
    });
    m_bytes->setDocument(m_document);
    const int type = m_document->hasHeader() ? m_document->type() : -1;
    if (m_openedType != type) {
        m_openedType = type;
        m_fields->openFirst();
    }
    if (m_document->hasHeader() && m_document->kind() == model::PacketKind::Datagram) {
        m_type = m_document->type();
    }
    QString owner;
    if (m_document->hasHeader()) {
        const model::CharacterKey key{packet.sender, m_document->header().character};
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
        number = comparableBefore(m_view, m_document->number());
    } else if (m_comparison == Comparison::Reference) {
        number = m_reference;
    }
    if (const auto packet = number ? m_view.packet(*number) : std::nullopt) {
        other = std::make_shared<FieldDocument>(*packet, unitOf(m_view, *packet));
    }
    const bool isSameType = other != nullptr && other->hasHeader() && m_document->hasHeader() &&
                            other->type() == m_document->type();
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
        m_commands.selectPacket(m_document->number());
    }
    m_fields->change([this] { showComparison(); });
    describeProblems();
}

void InspectorPanel::setReference() {
    if (m_isShown) {
        m_reference = m_document->number();
    }
}

QString InspectorPanel::comparisonText() const {
    if (m_comparison == Comparison::None) {
        return {};
    }
    if (const FieldDocument* other = m_model.other()) {
        const QString count = m_model.differences() == 1 ? tr("1 field differs")
                                                         : tr("%1 fields differ").arg(m_model.differences());
        const double apartMs = log::millisecondsOf(m_document->stamp() - other->stamp());
        return tr("Compared with packet %1, %2 ms apart: %3")
            .arg(grouped(other->number()), signedFixed(apartMs, 2), count);
    }
    return m_comparison == Comparison::Previous
               ? tr("No earlier packet of this stream to compare with")
               : tr("The reference is of another type or no longer in the history: only packets of one type "
                    "can be compared");
}

void InspectorPanel::describeProblems() {
    QStringList lines;
    for (std::size_t i = 0; i < m_document->problems().size(); ++i) {
        const FieldProblem& problem = m_document->problems()[i];
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

/// While no field is selected, its room describes the packet as a whole.
void InspectorPanel::describePacket() {
    if (!m_isShown) {
        m_detail->clear();
        return;
    }
    const QStringList facts = documentLines(*m_document);
    QStringList lines{QStringLiteral("<b>%1</b>").arg(documentTitle(*m_document).toHtmlEscaped()),
                      facts.value(0).toHtmlEscaped()};
    for (const QString& fact : facts.mid(1)) {
        lines += coloured(theme().dim, fact);
    }
    setLines(*m_detail, lines);
}

void InspectorPanel::describe(std::int32_t node) {
    if (node < 0 || node >= m_document->count()) {
        describePacket();
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
        showFound(*selection.found);
        return;
    }
    if (isOtherPacket && isNewPacket) {
        const auto& problems = m_document->problems();
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

/// The field that the found bytes begin in, and all of them.
void InspectorPanel::showFound(const model::FoundBytes& found) {
    if (const std::int32_t node = m_document->nodeAt(found.begin); node >= 0) {
        showField(node);
    }
    m_bytes->setSelected({found.begin, found.end});
    m_bytes->scrollTo(found.begin);
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
    if (segment >= 0 && m_document->hasHeader() && segment != m_view.choices().selection.segment) {
        model::Selection selection = m_view.choices().selection;
        selection.sender = m_document->sender();
        selection.character = model::CharacterKey{m_document->sender(), m_document->header().character};
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
    if (node >= 0) {
        showField(node);
        m_bytes->scrollTo(rangeOf(*m_document, node).begin);
    }
}

void InspectorPanel::showField(std::int32_t node) {
    m_fields->setCurrentNode(node);
    // Not shown where only differences are, and it has none: its bytes are there all the same.
    if (const QModelIndex index = m_model.indexOf(node); index.isValid()) {
        m_fields->expand(index);
        m_fields->scrollTo(index, m_document->itemOf(node) == node ? QAbstractItemView::PositionAtTop
                                                                   : QAbstractItemView::PositionAtCenter);
    }
    describeCurrent();
}

void InspectorPanel::openMenu(const QPoint& at) {
    m_fields->showMenu(at, QString::fromStdString(m_view.choices().displayFilter));
}

void InspectorPanel::step(int direction) {
    if (const auto found =
            m_isShown ? neighbourInStream(m_view, m_document->number(), direction) : std::nullopt) {
        m_commands.selectPacket(*found);
    }
}

void InspectorPanel::hold(bool isHeld) {
    if (isHeld && m_isShown) {
        m_commands.selectPacket(m_document->number());
    } else {
        model::Selection selection = m_view.choices().selection;
        selection.packet.reset();
        m_commands.select(selection);
    }
}

QString InspectorPanel::summary() const {
    if (!m_isShown) {
        return {};
    }
    const QString number = tr("packet %1").arg(grouped(m_document->number()));
    return m_view.choices().selection.packet ? number : tr("following · %1").arg(number);
}

void InspectorPanel::resizeEvent(QResizeEvent* event) {
    Panel::resizeEvent(event);
    const bool isWide = width() > 2 * height() && width() > fontMetrics().averageCharWidth() * 100;
    m_splitter->setOrientation(isWide ? Qt::Horizontal : Qt::Vertical);
}

void InspectorPanel::changeEvent(QEvent* event) {
    Panel::changeEvent(event);
    if (event->type() == QEvent::StyleChange && m_isShown) {
        describeProblems();
        describeCurrent();
    }
}

} // namespace posewire::gui
