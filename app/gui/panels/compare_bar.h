// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/comparison.h"
#include "app/gui/models/comparison_text.h"
#include "app/gui/theme/widgets.h"

#include <QDoubleSpinBox>
#include <QWidget>

namespace posewire::gui {

/// What the colours of differences mean: "0 ▬▬▬ 50 mm".
class DifferenceLegend final : public QWidget {
    Q_OBJECT

public:
    explicit DifferenceLegend(QWidget* parent);

    void setScale(const DifferenceScale& scale);
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    [[nodiscard]] QString fullText() const;

    DifferenceScale m_scale;
};

/// With whom the shown character is compared, and how the two recordings are laid over each other.
class CompareBar final : public QWidget {
    Q_OBJECT

public:
    explicit CompareBar(QWidget* parent);

    void refresh(const ComparisonState& state);

signals:
    void partnerChosen(const model::CharacterKey& second);
    void alignmentChosen(std::optional<posewire::exporting::AlignBy> by);
    void offsetChosen(double offset);
    void nudged(int samples);
    void frameChosen(posewire::model::DifferenceFrame frame);
    void besideToggled();

private:
    void fillPartners(const ComparisonState& state);
    void layOut();

    ComboBox* m_partner;
    ComboBox* m_by;
    QToolButton* m_earlier;
    QDoubleSpinBox* m_offset = new QDoubleSpinBox(this);
    QToolButton* m_later;
    ComboBox* m_frame;
    QToolButton* m_beside;
    std::vector<model::CharacterKey> m_partners; ///< as listed
};

} // namespace posewire::gui
