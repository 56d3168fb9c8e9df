// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/presenter.h"

#include <memory>

namespace posewire::gui {

/// Pictures drawn straight into the window by graphics hardware. Only to be made where hasHardwareOpenGl().
class OpenGlPresenter final : public Presenter {
    Q_OBJECT

public:
    explicit OpenGlPresenter(QWidget* parent);
    ~OpenGlPresenter() override;

    [[nodiscard]] bool isReady() const override;
    void present(std::shared_ptr<const SceneFrame> frame) override;
    [[nodiscard]] QString rendererName() const override;
    [[nodiscard]] QString failure() const override;

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    class View;
    View* m_view;
};

} // namespace posewire::gui
