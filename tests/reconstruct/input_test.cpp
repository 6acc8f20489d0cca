#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/data.h"
#include "tests/reconstruct/synthetic.h"

namespace bpms {
namespace {

const std::string header = "plant,axis,rank,organ,feature,point,view,camera,u_px,v_px,sigma_px\n";
const std::string good = "1,1,1,leaf,midrib,1,a,left,1200,600,0.5\n1,1,1,leaf,midrib,1,a,right,400,600,0.5\n";

Vectors from(const std::string& rows, const ReconstructOptions& options = {}) {
  const test::TemporaryFolder folder;
  return reconstruct(read_image_points(folder.write("p.csv", header + rows)), test::parallel_rig(), options);
}

TEST(Input, BadRowsAreNamed) {
  struct Case {
    std::string rows;
    std::string message;
  };
  const std::vector<Case> cases{
      {good + "1,1,1,leaf,midrib,2,a,lft,1,2,0.5\n",
       "p.csv:4:19: the rig has no camera 'lft'; did you mean 'left'?"},
      {good + "1,1,1,leaf,midrib,2,a,right,1600,2,0.5\n",
       "p.csv:4:19: the pixel (1600, 2) lies outside the image of camera 'right', 1600x1200 pixels"},
      {"1,1,1,leaf,midrib,2,a,left,3,-0.6,0.5\n" + good,
       "p.csv:2:19: the pixel (3, -0.6) lies outside the image of camera 'left', 1600x1200 pixels"},
      {"1,1,1,leaf,midrib,2,a,left,3,1199.6,0.5\n", "p.csv:2:19: the pixel (3, 1199.6) lies outside"},
      {good + "1,1,1,leaf,midrib,1,b,left,1200,600,0.5\n",
       "p.csv:4:19: plant 1 axis 1 rank 1 leaf midrib point 1 stands in view 'a' and in view 'b'"},
      {good + "1,1,1,leaf,midrib,1,a,left,1200,600,0.5\n",
       "p.csv:4:19: plant 1 axis 1 rank 1 leaf midrib point 1 stands twice"},
      {good + "1,1,1,leaf,midrib,2,a,left,1e99,2,0.5\n", "p.csv:4:28: "},
      {good + "1,1,1,leaf,midrib,2,a,left,1,2,-0.5\n", "p.csv:4:32: found -0.5, expected a sigma above 0 px"},
  };
  for (const Case& c : cases) BPMS_EXPECT_ERROR(from(c.rows), ErrorKind::bad_input, c.message);
}

TEST(Input, TheImageEndsHalfAPixelBeyondItsOuterPixelCentres) {
  EXPECT_NO_THROW(
      from("1,1,1,leaf,midrib,1,a,left,1599.5,-0.5,0.5\n1,1,1,leaf,midrib,1,a,right,-0.5,-0.5,0.5\n"));
}

TEST(Input, AViewCanBeChosen) {
  const std::string two =
      good + "1,1,1,leaf,midrib,1,b,left,1200,600,0.5\n1,1,1,leaf,midrib,1,b,right,500,600,0.5\n";
  ReconstructOptions options;
  options.view = "b";
  const auto points = from(two, options).points;
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points.front().estimate->x_m.z(), test::parallel_focal_px * test::parallel_baseline_m / 700,
              1e-9);
  options.view = "c";
  BPMS_EXPECT_ERROR(from(two, options), ErrorKind::bad_input, "no point is of view 'c'");
}

// As people digitise: the view says the image, and each image is of another camera.
TEST(Input, ViewsNamedAfterTheirImagesAreOneFrame) {
  const std::string left = "1,1,1,leaf,midrib,1,l.png,left,1200,600,0.5\n",
                    right = "1,1,1,leaf,midrib,1,r.png,right,400,600,0.5\n";
  for (const std::string& rows : {left + right, right + left}) {
    const Vectors vectors = from(rows);
    ASSERT_EQ(vectors.points.size(), 1u);
    EXPECT_EQ(vectors.points[0].view, "l.png+r.png");
    EXPECT_EQ(vectors.points[0].estimate->x_m, from(good).points[0].estimate->x_m);
    EXPECT_THAT(vectors.notes, ::testing::ElementsAre(::testing::HasSubstr("'l.png+r.png'")));
  }
  EXPECT_TRUE(from(good).notes.empty());
  // A second image of a camera, or a second camera in a view, and views are frames again.
  for (const char* more :
       {"1,1,1,leaf,midrib,2,m.png,left,1200,600,0.5\n", "1,1,1,leaf,midrib,2,l.png,right,400,600,0.5\n"})
    BPMS_EXPECT_ERROR(from(left + right + more), ErrorKind::bad_input,
                      "stands in view 'l.png' and in view 'r.png'");
  ReconstructOptions options;
  options.view = "l.png";
  EXPECT_EQ(from(left + right, options).points.at(0).reason, "seen in one image only");
}

TEST(Input, PointsThatCannotBeReconstructedAreKeptWithTheirReason) {
  const Vectors vectors =
      from(good +
           "1,1,2,leaf,midrib,1,a,left,1200,600,0.5\n"
           "1,1,3,leaf,midrib,1,a,left,700,600,0.5\n1,1,3,leaf,midrib,1,a,right,900,600,0.5\n"
           "1,1,4,leaf,midrib,1,a,left,800,600,0.5\n1,1,4,leaf,midrib,1,a,right,800,600,0.5\n");
  ASSERT_EQ(vectors.points.size(), 4u);
  EXPECT_TRUE(vectors.points[0].accepted());
  EXPECT_EQ(vectors.points[1].reason, "seen in one image only");
  EXPECT_EQ(vectors.points[2].reason, "behind a camera");
  EXPECT_EQ(vectors.points[3].reason, "parallel rays");
  EXPECT_EQ(vectors.accepted().size(), 1u);
  EXPECT_EQ(vectors.points[3].where.line, 7);
}

TEST(Input, TheOrderOfTheRowsDoesNotMatter) {
  const Rig rig = test::convergent_rig(3);
  Philox random(70);
  std::vector<ImagePoint> points;
  for (int i = 0; i < 10; ++i) {
    const auto rows = test::image_points(rig, i, test::sight(rig, test::somewhere(random), 0.5, &random));
    points.insert(points.end(), rows.begin(), rows.end());
  }
  const std::string forward = vectors_csv(reconstruct(points, rig).accepted());
  std::reverse(points.begin(), points.end());
  EXPECT_EQ(vectors_csv(reconstruct(points, rig).accepted()), forward);
}

}  // namespace
}  // namespace bpms
