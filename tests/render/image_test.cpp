// SPDX-License-Identifier: MIT
#include "tests/support/images.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace posewire::render::test {
namespace {

Image gradient(PixelOrder order) {
    Image image{7, 5, order, {}};
    for (int i = 0; i < image.width * image.height; ++i) {
        const auto value = static_cast<std::uint8_t>(5 * i);
        image.pixels.insert(image.pixels.end(), {value, 20, 200, 255});
    }
    return image;
}

class ImageFile : public ::testing::Test {
protected:
    std::filesystem::path path() const {
        const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
        return std::filesystem::path(::testing::TempDir()) /
               (std::string("posewire_") + test->name() + ".png");
    }
    void TearDown() override { std::filesystem::remove(path()); }
};

TEST_F(ImageFile, ComesBackAsWritten) {
    const Image image = gradient(PixelOrder::Rgba);
    ASSERT_TRUE(writePng(image, path()).has_value());
    const auto read = readPng(path());
    ASSERT_TRUE(read.has_value()) << read.error();
    EXPECT_EQ(read->pixels, image.pixels);
    EXPECT_EQ(read->width, 7);
    EXPECT_EQ(read->height, 5);
}

TEST_F(ImageFile, KeepsColoursWhateverTheOrder) {
    ASSERT_TRUE(writePng(gradient(PixelOrder::Bgra), path()).has_value());
    const auto read = readPng(path());
    ASSERT_TRUE(read.has_value()) << read.error();
    EXPECT_EQ(read->order, PixelOrder::Rgba);
    EXPECT_EQ(read->pixels[0], 200);
    EXPECT_EQ(read->pixels[2], 0);
    EXPECT_EQ(compareImages(*read, gradient(PixelOrder::Bgra), 0).largest, 0);
}

TEST_F(ImageFile, NamesTheFileInItsErrors) {
    const auto missing = readPng(path());
    ASSERT_FALSE(missing.has_value());
    EXPECT_NE(missing.error().find(path().string()), std::string::npos);
    std::ofstream(path()) << "no picture";
    EXPECT_FALSE(readPng(path()).has_value());
    EXPECT_FALSE(writePng(gradient(PixelOrder::Rgba), path() / "inside_a_file.png").has_value());
    EXPECT_FALSE(writePng(Image(), path()).has_value());
}

TEST(ImageComparison, CountsPixelsAndNotChannels) {
    const Image a = gradient(PixelOrder::Rgba);
    Image b = a;
    b.pixels[0] = static_cast<std::uint8_t>(b.pixels[0] + 10);
    b.pixels[1] = static_cast<std::uint8_t>(b.pixels[1] + 4);
    b.pixels[8] = static_cast<std::uint8_t>(b.pixels[8] + 2);
    const ImageDifference difference = compareImages(a, b, 2);
    EXPECT_TRUE(difference.sameSize);
    EXPECT_EQ(difference.largest, 10);
    EXPECT_DOUBLE_EQ(difference.shareBeyond, 1.0 / 35.0);
    EXPECT_DOUBLE_EQ(difference.mean, 16.0 / 105.0);
    EXPECT_DOUBLE_EQ(compareImages(a, b, 1).shareBeyond, 2.0 / 35.0);
}

TEST(ImageComparison, ReportsSizesThatDisagree) {
    const Image a = gradient(PixelOrder::Rgba);
    const Image turned{5, 7, PixelOrder::Rgba, a.pixels};
    EXPECT_FALSE(compareImages(a, turned, 2).sameSize);
    EXPECT_TRUE(differenceImage(a, turned).pixels.empty());
}

TEST(ImageComparison, ShowsWhereTheDifferenceIs) {
    const Image a = gradient(PixelOrder::Rgba);
    Image b = a;
    b.pixels[4] = static_cast<std::uint8_t>(b.pixels[4] + 1);
    const Image difference = differenceImage(a, b);
    EXPECT_EQ(difference.pixels[4], 16);
    EXPECT_EQ(difference.pixels[0], 0);
}

TEST(ImageComparison, OfNothingIsNoDifference) {
    const ImageDifference difference = compareImages(Image(), Image(), 0);
    EXPECT_TRUE(difference.sameSize);
    EXPECT_EQ(difference.largest, 0);
    EXPECT_TRUE(differenceImage(Image(), Image()).pixels.empty());
}

TEST(ImageComparison, ShowsGreatDifferencesAtFullStrength) {
    const Image a = gradient(PixelOrder::Rgba);
    Image b = a;
    b.pixels[6] = 0;
    EXPECT_EQ(differenceImage(a, b).pixels[6], 255);
    EXPECT_EQ(differenceImage(a, b).pixels[7], 255);
}

TEST_F(ImageFile, RefusesAPictureThatIsCutOff) {
    ASSERT_TRUE(writePng(gradient(PixelOrder::Rgba), path()).has_value());
    std::filesystem::resize_file(path(), std::filesystem::file_size(path()) / 2);
    const auto cut = readPng(path());
    ASSERT_FALSE(cut.has_value());
    EXPECT_NE(cut.error().find(path().string()), std::string::npos) << cut.error();
}

TEST_F(ImageFile, RefusesToWriteTooFewPixels) {
    Image image = gradient(PixelOrder::Rgba);
    image.pixels.pop_back();
    EXPECT_FALSE(writePng(image, path()).has_value());
    EXPECT_FALSE(std::filesystem::exists(path()));
}

} // namespace
} // namespace posewire::render::test
