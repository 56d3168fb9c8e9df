// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/picture_series.h"

#include "render/offscreen.h"
#include "tests/app/gui/models/stage.h"

#include <QDir>
#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

namespace posewire::gui {
namespace {

class PictureSeriesTest : public testing::Test {
protected:
    void SetUp() override {
        if (!render::OffscreenRenderer::create()) {
            GTEST_SKIP() << "SKIPPED: no OpenGL by EGL on this computer";
        }
        stage.perform(performer, 0, 60);
        stage.follow();
        request.first = Stage::kStart;
        request.every = 250ms;
        request.count = 3;
        request.size = {320, 240};
        request.path = folder.filePath("walk.png");
    }
    /// What it said at the end.
    QString write() {
        PictureSeries series(stage.session, stage.playback, ViewLook{}, request);
        QSignalSpy finished(&series, &PictureSeries::finished);
        series.start();
        EXPECT_TRUE(finished.count() > 0 || finished.wait(30'000));
        written = series.written();
        return finished.isEmpty() ? "nothing was said" : finished[0][0].toString();
    }

    Stage stage;
    performer::Performer performer{sending(1, {2, 12, 13}, 60.0)};
    QTemporaryDir folder;
    PictureRequest request;
    int written = 0;
};

TEST_F(PictureSeriesTest, WritesEachMomentToAFileOfItsOwn) {
    EXPECT_EQ(write(), "");
    EXPECT_EQ(written, 3);
    const QStringList files = QDir(folder.path()).entryList({"*.png"});
    ASSERT_EQ(files, (QStringList{"walk_1.png", "walk_2.png", "walk_3.png"}));
    const QImage first(folder.filePath(files[0]));
    const QImage last(folder.filePath(files[2]));
    EXPECT_EQ(first.size(), QSize(320, 240));
    EXPECT_NE(first, last) << "half a second later the walker stands elsewhere";
    EXPECT_EQ(stage.session.choices().cursor.mode, model::Cursor::Mode::Following) << "as before";
}

TEST_F(PictureSeriesTest, MomentsWithoutAnythingNewArePicturesToo) {
    request.first = Stage::kStart + 10s;
    EXPECT_EQ(write(), "");
    EXPECT_EQ(written, 3);
    EXPECT_EQ(QImage(folder.filePath("walk_1.png")), QImage(folder.filePath("walk_3.png")));
}

TEST_F(PictureSeriesTest, OneAloneHasTheNameThatWasChosen) {
    request.count = 1;
    stage.playback.showMoment(Stage::kStart + 500ms);
    const model::Cursor before = stage.session.choices().cursor;
    EXPECT_EQ(write(), "");
    EXPECT_TRUE(QFile::exists(request.path));
    EXPECT_EQ(stage.session.choices().cursor, before);
}

TEST_F(PictureSeriesTest, LabelsAreInThePictureAndGrowWithIt) {
    request.count = 1;
    request.size = {800, 600};
    EXPECT_EQ(write(), "");
    const QImage small(request.path);
    request.scale = 2;
    EXPECT_EQ(write(), "");
    EXPECT_NE(small, QImage(request.path)) << "the same picture, but for the words in it";
}

TEST_F(PictureSeriesTest, SaysWhyAPictureCannotBeWritten) {
    request.path = folder.filePath("none/walk.png");
    EXPECT_TRUE(write().contains("none/walk_1.png"));
    EXPECT_EQ(written, 0);
}

TEST_F(PictureSeriesTest, WhatIsGivenUpLeavesWholePictures) {
    request.count = 500;
    {
        PictureSeries series(stage.session, stage.playback, ViewLook{}, request);
        series.start();
        ASSERT_TRUE(QTest::qWaitFor([&] { return series.written() >= 2; }, 30'000));
        written = series.written();
    }
    const QStringList files = QDir(folder.path()).entryList(QDir::Files | QDir::Hidden);
    EXPECT_EQ(files.size(), written);
    for (const QString& file : files) {
        EXPECT_FALSE(QImage(folder.filePath(file)).isNull()) << file.toStdString();
    }
}

} // namespace
} // namespace posewire::gui
