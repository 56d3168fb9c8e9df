// SPDX-License-Identifier: GPL-3.0-or-later
// Photographs every dock, empty and busy, in both themes and at two scales, into the folder `pictures` of the
// build, for people to look at; checks what a machine can.
#include "app/gui/plots/time_plot.h"
#include "app/gui/theme/theme.h"
#include "tests/app/gui/panels/panel_stage.h"

#include <QApplication>
#include <QDir>
#include <QElapsedTimer>
#include <QImage>
#include <QPainter>

#include <memory>
#include <set>

namespace posewire::gui {

namespace {

struct Look {
    ThemeChoice theme;
    int scale;
    const char* name;
};
constexpr Look kLooks[] = {{ThemeChoice::Dark, 1, "dark-100"},
                           {ThemeChoice::Light, 1, "light-100"},
                           {ThemeChoice::Dark, 2, "dark-200"},
                           {ThemeChoice::Light, 2, "light-200"}};

/// A title as docks have it, so that pictures show the panel as it will be seen.
constexpr int kTitle = 26;

QImage photograph(Panel& panel, const QString& title, int scale) {
    const QSize size = panel.size() + QSize(0, kTitle);
    QImage image(size * scale, QImage::Format_RGB32);
    image.setDevicePixelRatio(scale);
    image.fill(theme().header);
    QPainter painter(&image);
    painter.setPen(theme().text);
    painter.drawText(QRect(8, 0, size.width(), kTitle), Qt::AlignVCenter, title);
    painter.setPen(theme().dim);
    painter.drawText(QRect(0, 0, size.width() - 8, kTitle), Qt::AlignVCenter | Qt::AlignRight,
                     panel.summary());
    panel.render(&painter, QPoint(0, kTitle));
    return image;
}

std::size_t coloursIn(const QImage& image) {
    std::set<QRgb> colours;
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            colours.insert(image.pixel(x, y));
        }
    }
    return colours.size();
}

/// All of one occasion on one sheet, two below each other.
QImage sideBySide(const std::vector<QImage>& images) {
    QSize sheet;
    std::vector<QPoint> places;
    QPoint at;
    for (std::size_t i = 0; i < images.size(); ++i) {
        places.push_back(at);
        sheet = sheet.expandedTo(QSize(at.x() + images[i].width(), at.y() + images[i].height()));
        at = i % 2 == 0 ? at + QPoint(0, images[i].height() + 8) : QPoint(sheet.width() + 8, 0);
    }
    QImage image(sheet, QImage::Format_RGB32);
    image.fill(theme().line);
    QPainter painter(&image);
    for (std::size_t i = 0; i < images.size(); ++i) {
        QImage part = images[i];
        part.setDevicePixelRatio(1);
        painter.drawImage(places[i], part);
    }
    return image;
}

class PicturesTest : public testing::TestWithParam<Look> {
protected:
    void SetUp() override { applyTheme(*qApp, GetParam().theme); }

    /// Refreshes ten times a second while a sender plays, then takes the pictures.
    void photographAll(const QString& occasion, const std::function<void(int tick)>& play, int ticks) {
        std::vector<std::unique_ptr<Panel>> panels;
        for (const PanelInfo& info : panelTable()) {
            panels.emplace_back(info.make(m_stage.parts, nullptr));
            const bool isTall = panels.back()->findChild<TimePlot*>() != nullptr;
            panels.back()->resize(info.area == Qt::LeftDockWidgetArea ? 330 : 390, isTall ? 640 : 300);
            panels.back()->show();
        }
        log::Duration refresh{};
        for (int tick = 0; tick < ticks; ++tick) {
            play(tick);
            m_stage.now = std::max(m_stage.now, Stage::kStart + (tick + 1) * 100ms);
            m_stage.follow();
            QElapsedTimer timer;
            timer.start();
            for (const auto& panel : panels) {
                panel->refresh();
            }
            refresh += log::Duration(timer.nsecsElapsed());
        }
        RecordProperty("microsecondsPerRefresh", static_cast<int>(refresh / ticks / 1us));
        const QDir folder(POSEWIRE_PICTURE_FOLDER);
        ASSERT_TRUE(folder.mkpath("."));
        std::vector<QImage> images;
        for (std::size_t i = 0; i < panels.size(); ++i) {
            QApplication::processEvents();
            const PanelInfo& info = panelTable()[i];
            const QImage image = photograph(*panels[i], info.title, GetParam().scale);
            const QString name = QString("%1-%2-%3.png").arg(info.id, occasion, GetParam().name);
            EXPECT_TRUE(image.save(folder.filePath(name)));
            EXPECT_GT(coloursIn(image), 8U) << name.toStdString();
            images.push_back(image);
        }
        const QString name = QString("all-%1-%2.png").arg(occasion, GetParam().name);
        EXPECT_TRUE(sideBySide(images).save(folder.filePath(name)));
    }

    PanelStage m_stage;
};

TEST_P(PicturesTest, Empty) {
    photographAll(
        "empty", [](int) {}, 2);
}

TEST_P(PicturesTest, Busy) {
    performer::Performer performer(sending(2, {2, 12, 13, 20, 23, 25}));
    photographAll(
        "busy",
        [&](int tick) {
            const auto frame = static_cast<std::uint64_t>(tick) * 24;
            m_stage.perform(performer, frame, frame + 24, [tick](std::uint64_t n) {
                return !(tick == 70 && n % 24 < 12) && n % 977 != 13;
            });
            if (tick == 5) {
                m_stage.sendMetadata("mood:fine\nname:Factory\ncolor:e96417\n", m_stage.now);
            }
            m_stage.session.setSelection({m_stage.sender(), m_stage.key(), 10});
        },
        120);
}

TEST_P(PicturesTest, TwoMinutes) {
    performer::Performer performer(sending(2, {2, 23, 25}, 30.0));
    photographAll(
        "long",
        [&](int tick) {
            const auto frame = static_cast<std::uint64_t>(tick) * 3;
            m_stage.perform(performer, frame, frame + 3,
                            [](std::uint64_t n) { return !(n / 30 % 41 == 17) && n % 1000 != 998; });
        },
        1300);
}

TEST_P(PicturesTest, Overloaded) {
    performer::Performer performer(sending(4, {1, 2, 3, 5, 12, 13, 20, 21, 22, 23, 24, 25}));
    const std::string foreign = "{\"type\":\"transport\"}";
    photographAll(
        "overloaded",
        [&](int tick) {
            const auto frame = static_cast<std::uint64_t>(tick) * 24;
            m_stage.perform(performer, frame, frame + 24, [](std::uint64_t n) { return n % 5 != 3; });
            m_stage.sendBytes(std::as_bytes(std::span(foreign)), m_stage.now, "192.168.10.34:49800");
            if (tick == 29) {
                m_stage.now += 400ms;
            }
        },
        30);
}

INSTANTIATE_TEST_SUITE_P(Looks, PicturesTest, testing::ValuesIn(kLooks),
                         [](const auto& look) { return QString(look.param.name).remove('-').toStdString(); });

} // namespace

} // namespace posewire::gui
