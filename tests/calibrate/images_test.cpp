// Image files as they come: more bits than 8, turned, cut short, damaged, huge by their own account, there
// twice, from another camera; targets that are blurred, overexposed, several in an image or in it twice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "calibrate/images/find_corners.h"
#include "calibrate/images/image_file.h"
#include "calibrate/images/view_quality.h"
#include "calibrate/targets/target_kind.h"
#include "core/text.h"
#include "tests/calibrate/rendered_target.h"
#include "tests/data.h"

namespace bpms {
namespace {

using test::render_drawing, test::TargetView, test::view_of, ::testing::HasSubstr;

const Target& board() {
  static const Target target = parse_target("chessboard:9x6:25mm");
  return target;
}
cv::Mat picture(double roll_deg, double blur_px = 0.7) {
  const Drawing drawing = draw_target(board());
  TargetView view = view_of(drawing, roll_deg, 20, 30);
  view.blur_px = blur_px;
  return render_drawing(drawing, view);
}

std::string jpeg(const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, 95});
  return {bytes.begin(), bytes.end()};
}

// An EXIF segment with the orientation, the model and the focal length, behind the first two bytes.
std::string with_exif(const std::string& image, int orientation, const std::string& model, int focal_mm) {
  const auto number = [](unsigned value, int bytes) {
    std::string out;
    for (int i = bytes - 1; i >= 0; --i) out += static_cast<char>((value >> (8 * i)) & 0xff);
    return out;
  };
  const auto entry = [&](unsigned tag, unsigned type, unsigned count, const std::string& value) {
    return number(tag, 2) + number(type, 2) + number(count, 4) + value;
  };
  const unsigned first = 8, exif_at = first + 2 + 3 * 12 + 4, text_at = exif_at + 2 + 12 + 4,
                 ratio_at = text_at + 16;
  std::string text = model;
  text.resize(16, '\0');
  const std::string tiff = std::string("MM\0*", 4) + number(first, 4) + number(3, 2) +
                           entry(0x110, 2, 16, number(text_at, 4)) +
                           entry(0x112, 3, 1, number(static_cast<unsigned>(orientation), 2) + number(0, 2)) +
                           entry(0x8769, 4, 1, number(exif_at, 4)) + number(0, 4) + number(1, 2) +
                           entry(0x920a, 5, 1, number(ratio_at, 4)) + number(0, 4) + text +
                           number(static_cast<unsigned>(focal_mm) * 10, 4) + number(10, 4);
  const std::string segment = std::string("Exif\0\0", 6) + tiff;
  return image.substr(0, 2) + "\xff\xe1" + number(static_cast<unsigned>(segment.size()) + 2, 2) + segment +
         image.substr(2);
}

TEST(ImageFile, ScalesTwelveBitsInSixteen) {
  const test::TemporaryFolder folder;
  const cv::Mat eight = picture(5);
  cv::Mat twelve;
  eight.convertTo(twelve, CV_16U, 16);  // 0 .. 4080 of 65535
  cv::imwrite(folder / "a1.png", twelve);
  const ImageFile file = read_image_file(folder / "a1.png");
  ASSERT_TRUE(file.trouble.empty()) << file.trouble;
  EXPECT_THAT(file.remarks, ::testing::Contains(HasSubstr("16 bits scaled to 8")));
  double low = 0, high = 0;
  cv::minMaxLoc(file.grey, &low, &high);
  EXPECT_EQ(low, 0);
  EXPECT_EQ(high, 255);
  const Detection from_twelve = detect_target(file.grey, board()), from_eight = detect_target(eight, board());
  ASSERT_EQ(from_twelve.corners.size(), 54u);
  // Rounding to grey values differs: 0.3 of a step rms over the 200 of an edge and tens of pixels.
  for (std::size_t i = 0; i < 54; ++i)
    EXPECT_LT((from_twelve.corners[i].pixel - from_eight.corners[i].pixel).norm(), 0.01);
}

TEST(ImageFile, TakesPixelsAsStoredAndSaysSo) {
  const test::TemporaryFolder folder;
  const ImageFile file =
      read_image_file(folder.write("a1.jpg", with_exif(jpeg(picture(5)), 6, "Model X", 50)));
  EXPECT_EQ(file.trouble, "");
  EXPECT_EQ(file.grey.cols, 640);
  EXPECT_EQ(file.header.width_px, 640);
  EXPECT_EQ(file.header.orientation, 6);
  EXPECT_EQ(file.header.device(), "Model X, 50 mm");
  EXPECT_THAT(file.remarks, ::testing::Contains(HasSubstr("taken as stored")));
}

TEST(ImageFile, JpegAgreesWithOpenCvToTheBit) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("a1.jpg", jpeg(picture(5)));
  const cv::Mat theirs = cv::imread(path, cv::IMREAD_GRAYSCALE), ours = read_image_file(path).grey;
  EXPECT_EQ(cv::norm(theirs, ours, cv::NORM_INF), 0);
}

TEST(ImageFile, NamesWhatIsCutShortDamagedOrTooLarge) {
  const test::TemporaryFolder folder;
  const std::string whole = jpeg(picture(5));
  for (const double share : {0.99, 0.7, 0.3, 0.01})
    EXPECT_THAT(read_image_file(
                    folder.write("a.jpg", whole.substr(0, static_cast<std::size_t>(
                                                              share * static_cast<double>(whole.size())))))
                    .trouble,
                HasSubstr("cut short or damaged"))
        << share;
  // Cut short, and an end put behind it.
  EXPECT_THAT(read_image_file(folder.write("b.jpg", whole.substr(0, whole.size() / 2) + "\xff\xd9")).trouble,
              HasSubstr("cut short or damaged"));
  std::vector<unsigned char> png;
  cv::imencode(".png", picture(5), png);
  EXPECT_EQ(read_image_file(folder.write("c.png", std::string(png.begin(), png.end() - 40))).trouble,
            "is cut short");
  // A TIFF of 8 bytes and a folder that claims 100000 x 100000.
  const std::string tiff = std::string("II*\0\x08\0\0\0\x02\0", 10) +
                           std::string("\0\x01\x04\0\x01\0\0\0\xa0\x86\x01\0", 12) +
                           std::string("\x01\x01\x04\0\x01\0\0\0\xa0\x86\x01\0", 12) + std::string(4, '\0');
  EXPECT_THAT(read_image_file(folder.write("d.tif", tiff)).trouble, HasSubstr("100000x100000 pixels"));
  EXPECT_EQ(read_image_file(folder.write("e.jpg", "")).trouble, "is empty");
  EXPECT_EQ(read_image_file(folder / "none.jpg").trouble, "no such file");
  EXPECT_EQ(read_image_file(folder.write("f.jpg", "no image")).trouble, "cannot be read as an image");
}

TEST(FindCorners, SkipsRepeatedFilesAndOtherCamerasByName) {
  const test::TemporaryFolder folder;
  std::vector<std::string> paths;
  for (int i = 1; i <= 3; ++i)
    paths.push_back(
        folder.write(fmt::format("left{}.jpg", i), with_exif(jpeg(picture(5 * i)), 1, "Model X", 50)));
  paths.push_back(folder.write("left4.jpg", read_file(paths[1])));
  paths.push_back(folder.write("left5.jpg", with_exif(jpeg(picture(22)), 1, "Model Y", 50)));
  paths.push_back(folder.write("left6.jpg", with_exif(jpeg(picture(24)), 1, "Model X", 35)));
  paths.push_back(folder.write("left7.jpg", jpeg(picture(26)).substr(0, 9000)));
  const Observations found = find_corners(paths, board());
  EXPECT_EQ(found.views.size(), 3u);
  ASSERT_EQ(found.skipped.size(), 4u);
  EXPECT_THAT(found.skipped[0].reason, HasSubstr("left2.jpg, byte for byte"));
  EXPECT_THAT(found.skipped[1].reason, HasSubstr("taken by Model Y, 50 mm"));
  EXPECT_THAT(found.skipped[2].reason, HasSubstr("taken by Model X, 35 mm"));
  EXPECT_THAT(found.skipped[3].reason, HasSubstr("cut short"));
}

TEST(FindCorners, DrawsWhatItFound) {
  const test::TemporaryFolder folder;
  cv::imwrite(folder / "left1.png", picture(5));
  find_corners({folder / "left1.png"}, board(), {folder / "debug"});
  const cv::Mat drawn = cv::imread(folder / "debug/left_1.png");
  ASSERT_EQ(drawn.cols, 1280);
  int coloured = 0;
  for (auto it = drawn.begin<cv::Vec3b>(); it != drawn.end<cv::Vec3b>(); ++it)
    coloured += (*it)[0] != (*it)[1] || (*it)[1] != (*it)[2];
  EXPECT_GT(coloured, 54 * 20);
}

TEST(FindCorners, HasAViewOfEachTargetThatAnImageShows) {
  const test::TemporaryFolder folder;
  const std::vector<Target> targets = parse_targets(
      {"apriltag:3x2:40mm:10mm", "apriltag:2x2:40mm:10mm:20", "charuco:7x5:30mm:22mm:DICT_4X4_50"});
  cv::Mat both(480, 1280, CV_8U);
  for (int t = 0; t < 2; ++t) {
    const Drawing drawing = draw_target(targets[static_cast<std::size_t>(t)]);
    render_drawing(drawing, view_of(drawing, 5, 20, 30)).copyTo(both(cv::Rect(640 * t, 0, 640, 480)));
  }
  cv::imwrite(folder / "a1.png", both);
  const Observations found = find_corners({folder / "a1.png"}, targets);
  ASSERT_EQ(found.views.size(), 2u);
  EXPECT_EQ(found.views[0].target, 0);
  EXPECT_EQ(found.views[0].corners.size(), 24u);
  EXPECT_EQ(found.views[1].target, 1);
  EXPECT_EQ(found.views[1].corners.size(), 16u);
  EXPECT_GT(found.views[1].corners[0].pixel.x(), 640);
}

TEST(FindCorners, LeavesOutTagsThatAreThereTwiceAndTakesPartsOfBoards) {
  const test::TemporaryFolder folder;
  const Target target = parse_target("apriltag:3x2:40mm:10mm");
  const Drawing drawing = draw_target(target);
  const cv::Mat one = render_drawing(drawing, view_of(drawing, 0, 10, 0));
  cv::Mat two(480, 960, CV_8U);
  one.copyTo(two(cv::Rect(0, 0, 640, 480)));
  one(cv::Rect(0, 0, 320, 480)).copyTo(two(cv::Rect(640, 0, 320, 480)));  // the left half again
  cv::imwrite(folder / "a1.png", two);
  const Observations found = find_corners({folder / "a1.png"}, target);
  ASSERT_EQ(found.views.size(), 1u);
  EXPECT_EQ(found.views[0].corners.size(), 16u);  // 1, 2, 4 and 5 of 0 .. 5
  ASSERT_EQ(found.remarks.size(), 2u);
  EXPECT_EQ(found.remarks[0].reason, "tag 0 is in the image 2 times and left out");
  EXPECT_EQ(found.remarks[1].reason, "tag 3 is in the image 2 times and left out");
  // Half of a ChArUco board: fewer corners, each with its own number.
  const Target charuco = parse_target("charuco:7x5:30mm:22mm:DICT_4X4_50");
  const Drawing squares = draw_target(charuco);
  const TargetView view = view_of(squares, 0, 10, 0);
  const Detection half =
      detect_target(render_drawing(squares, view)(cv::Rect(0, 0, 320, 480)).clone(), charuco);
  EXPECT_GE(half.corners.size(), 8u);
  EXPECT_LT(half.corners.size(), 16u);
  for (const ImageCorner& corner : half.corners)
    EXPECT_LT((corner.pixel - view.pixel(charuco.points_m()[static_cast<std::size_t>(corner.point)])).norm(),
              0.15);
}

TEST(ViewQuality, MeasuresTheBlurThatWasDrawn) {
  for (const double blur : {0.7, 1.5, 3.0}) {
    const cv::Mat image = picture(10, blur);
    const Detection found = detect_target(image, board());
    ASSERT_TRUE(found.found());
    const ViewQuality quality = view_quality(image, found.corners);
    EXPECT_NEAR(quality.blur_px, blur, 0.2 * blur);  // from one gradient a corner; enough to warn by
    EXPECT_NEAR(quality.contrast, 200, 10);
    EXPECT_EQ(quality_remarks(quality).size(), blur > 2.5 ? 1u : 0u);
  }
}

TEST(ViewQuality, TellsOverexposedAndFaintBoards) {
  cv::Mat bright = picture(10) * 1.3;  // white at 299
  const std::vector<ImageCorner> corners = detect_target(bright, board()).corners;
  ASSERT_EQ(corners.size(), 54u);
  EXPECT_NEAR(view_quality(bright, corners).overexposed, 0.5, 0.1);
  EXPECT_THAT(quality_remarks(view_quality(bright, corners)), ::testing::Contains(HasSubstr("overexposed")));
  cv::Mat faint = picture(10) / 8 + 100;
  EXPECT_THAT(quality_remarks(view_quality(faint, corners)),
              ::testing::Contains(HasSubstr("contrast of only")));
}

}  // namespace
}  // namespace bpms
