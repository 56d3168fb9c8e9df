// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/compare_bar.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/theme/theme.h"
#include "core/model/session/roster.h"

#include <QPainter>
#include <QSignalBlocker>

#include <algorithm>
#include <cmath>

namespace posewire::gui {

namespace {

using exporting::AlignBy;
using model::DifferenceFrame;

ComboBox* narrowBox(const QString& name, const QString& toolTip, QWidget* parent) {
    constexpr int kLetters = 10;
    auto* box = new ComboBox(parent);
    box->setAccessibleName(name);
    box->setToolTip(toolTipText(toolTip));
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    box->setMinimumContentsLength(kLetters);
    box->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    return box;
}

void setText(QComboBox& box, int index, const QString& text) {
    if (box.itemText(index) != text) {
        box.setItemText(index, text);
    }
}

} // namespace

DifferenceLegend::DifferenceLegend(QWidget* parent) : QWidget(parent) {
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Preferred);
}

void DifferenceLegend::setScale(const DifferenceScale& scale) {
    if (m_scale.full != scale.full || accessibleName().isEmpty()) {
        m_scale = scale;
        setAccessibleName(tr("Colours from 0 to %1").arg(fullText()));
        setToolTip(toolTipText(
            tr("Colours of the segments in the viewport and the table: from 0 to %1").arg(fullText())));
        updateGeometry();
    }
    update();
}

QString DifferenceLegend::fullText() const {
    return tr("%1 mm").arg(m_scale.full, 0, 'f', 0);
}

QSize DifferenceLegend::sizeHint() const {
    return {fontMetrics().horizontalAdvance(QStringLiteral("0 ") + fullText()) + 6 * fontMetrics().height(),
            fontMetrics().height()};
}

void DifferenceLegend::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setPen(theme().dim);
    const int zero = fontMetrics().horizontalAdvance(QStringLiteral("0 "));
    const int full = fontMetrics().horizontalAdvance(QLatin1Char(' ') + fullText());
    painter.drawText(rect(), Qt::AlignLeft | Qt::AlignVCenter, QStringLiteral("0"));
    painter.drawText(rect(), Qt::AlignRight | Qt::AlignVCenter, fullText());
    const int thick = fontMetrics().height() / 3;
    const QRect bar(zero, (height() - thick) / 2, width() - zero - full, thick);
    QLinearGradient colours(bar.topLeft(), bar.topRight());
    for (const double share : {0.0, 0.5, 1.0}) {
        colours.setColorAt(share, m_scale.colourOf(share * m_scale.full));
    }
    painter.fillRect(bar, colours);
}

CompareBar::CompareBar(QWidget* parent)
    : QWidget(parent),
      m_partner(narrowBox(tr("Compared with"), tr("The character of the second recording"), this)),
      m_by(narrowBox(tr("Aligned by"), tr("What says which samples of the two belong together"), this)),
      m_earlier(framedButton(QStringLiteral("◀"), tr("The second recording a sample earlier ([)"), this)),
      m_later(framedButton(QStringLiteral("▶"), tr("The second recording a sample later (])"), this)),
      m_frame(
          narrowBox(tr("Laid over each other"),
                    tr("As sent: where both stand in the room counts. On the spot: place on the floor and "
                       "heading do not. Without the pelvis: only the pose counts."),
                    this)),
      m_beside(framedButton(tr("Beside"), tr("Draw the second body at the side of the first one"), this)) {
    m_by->addItem(tr("Automatic"));
    for (const AlignBy by : {AlignBy::TimeCode, AlignBy::Sample, AlignBy::Begin}) { // in their order
        m_by->addItem(alignedByText(by));
    }
    for (const DifferenceFrame frame :
         {DifferenceFrame::World, DifferenceFrame::Heading, DifferenceFrame::Pelvis}) {
        m_frame->addItem(frameText(frame));
    }
    m_earlier->setAccessibleName(tr("A sample earlier"));
    m_later->setAccessibleName(tr("A sample later"));
    m_offset->setAccessibleName(tr("Offset of the second recording"));
    m_offset->setToolTip(tr("How much later the second recording is taken, by hand"));
    m_offset->setKeyboardTracking(false);
    m_offset->setMinimumWidth(fontMetrics().averageCharWidth() * 14); // whatever its range
    m_beside->setCheckable(true);
    layOut();
    connect(m_partner, &QComboBox::activated, this,
            [this](int index) { emit partnerChosen(m_partners[static_cast<std::size_t>(index)]); });
    connect(m_by, &QComboBox::activated, this, [this](int index) {
        emit alignmentChosen(index == 0 ? std::nullopt : std::optional(static_cast<AlignBy>(index - 1)));
    });
    connect(m_offset, &QDoubleSpinBox::valueChanged, this, &CompareBar::offsetChosen);
    connect(m_earlier, &QToolButton::clicked, this, [this] { emit nudged(-1); });
    connect(m_later, &QToolButton::clicked, this, [this] { emit nudged(1); });
    connect(m_frame, &QComboBox::activated, this,
            [this](int index) { emit frameChosen(static_cast<DifferenceFrame>(index)); });
    connect(m_beside, &QToolButton::clicked, this, &CompareBar::besideToggled);
}

void CompareBar::layOut() {
    const int space = fontMetrics().height() / 3;
    for (QToolButton* button : {m_earlier, m_later, m_beside}) {
        button->setFocusPolicy(Qt::StrongFocus);
    }
    for (QToolButton* button : {m_earlier, m_later}) {
        button->setAutoRepeat(true);
    }
    auto* column = tightColumn(this);
    column->setSpacing(space);
    auto* above = spacedRow({}, space);
    above->addWidget(m_partner, 1);
    above->addWidget(m_frame, 1);
    above->addWidget(m_beside);
    auto* below = spacedRow({}, space);
    below->addWidget(m_by, 1);
    below->addWidget(m_earlier);
    below->addWidget(m_offset, 1);
    below->addWidget(m_later);
    column->addLayout(above);
    column->addLayout(below);
}

void CompareBar::fillPartners(const ComparisonState& state) {
    std::vector<model::CharacterKey> keys;
    std::ranges::transform(state.second->atNow().roster().listed(), std::back_inserter(keys),
                           &model::Character::key);
    QStringList names;
    for (const model::CharacterKey& key : keys) {
        names += tr("with %1").arg(characterName(*state.second, key));
    }
    QStringList before;
    for (int i = 0; i < m_partner->count(); ++i) {
        before += m_partner->itemText(i);
    }
    if (keys != m_partners || names != before) {
        m_partners = keys;
        m_partner->clear();
        m_partner->addItems(names);
    }
    const auto current = state.pair ? std::ranges::find(keys, state.pair->second) : keys.end();
    m_partner->setCurrentIndex(current == keys.end() ? -1 : static_cast<int>(current - keys.begin()));
}

void CompareBar::refresh(const ComparisonState& state) {
    if (state.second != nullptr && !m_partner->view()->isVisible()) {
        fillPartners(state);
    }
    const auto& [by, offset, frame, pair, isBeside] = state.choice;
    setText(*m_by, 0,
            state.alignment && !by ? tr("Automatic: %1").arg(alignedByText(state.alignment->by))
                                   : tr("Automatic"));
    m_by->setCurrentIndex(by ? 1 + static_cast<int>(*by) : 0);
    m_frame->setCurrentIndex(static_cast<int>(frame));
    m_beside->setChecked(isBeside);
    const bool isCounts = state.alignment && state.alignment->by == AlignBy::Sample;
    constexpr double kDay = 86'400'000; // ms
    constexpr double kShown = 0.06;     // less makes no difference in the field
    const QSignalBlocker blocker(m_offset);
    if (const QString unit = isCounts ? tr(" samples") : tr(" ms"); unit != m_offset->suffix()) {
        m_offset->setRange(-kDay, kDay);
        m_offset->setDecimals(isCounts ? 0 : 1);
        m_offset->setSuffix(unit);
    }
    m_offset->setSingleStep(state.step);
    m_offset->setEnabled(state.alignment.has_value());
    if (std::abs(m_offset->value() - offset) > kShown) { // typing goes on
        m_offset->setValue(offset);
    }
}

} // namespace posewire::gui
