#include "core/records.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/data.h"

namespace bpms {
namespace {

using enum ErrorKind;
const std::string points_header = "plant,axis,rank,organ,feature,point,view,camera,u_px,v_px,sigma_px\n";

TEST(Records, VectorsRoundTrip) {
  VectorPoint point;
  point.label = {"p,1", "main", 3, "leaf", "midrib"};
  point.point = 7;
  point.x_m = {0.1, 1.0 / 3.0, -2e-5};
  point.covariance_m2 << 2e-6, 1e-7, 0, 1e-7, 3e-6, -2e-7, 0, -2e-7, 4e-6;
  const test::TemporaryFolder folder;
  const auto read = read_vectors(folder.write("v.csv", vectors_csv({point})));
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].label, point.label);
  EXPECT_EQ(read[0].point, 7);
  EXPECT_EQ(read[0].x_m, point.x_m);
  EXPECT_EQ(read[0].covariance_m2, point.covariance_m2);
}

TEST(Records, BadRowsAreNamed) {
  const test::TemporaryFolder folder;
  const auto read = [&](const std::string& rows) {
    read_image_points(folder.write("p.csv", points_header + rows));
  };
  BPMS_EXPECT_ERROR(read("1,1,1,leaf,midrib,1,a,left,1,2,0\n"), bad_input,
                    "p.csv:2:32: found 0, expected a sigma above 0 px");
  BPMS_EXPECT_ERROR(read("1,1,1,leaf,midrib,1,a,left,1,2,1\n1,1,1,leaf,midrib,1,a,left,1,2,1\n"), bad_input,
                    "stands twice");
  BPMS_EXPECT_ERROR(read("1,1,x,leaf,midrib,1,a,left,1,2,1\n"), bad_input,
                    "p.csv:2:5: found 'x' in column 'rank'");
  BPMS_EXPECT_ERROR(read(""), bad_input, "no points after the header");
  const std::string bad =
      "plant,axis,rank,organ,feature,point,x_m,y_m,z_m,xx,xy,xz,yy,yz,zz\n1,1,1,leaf,midrib,1,0,0,0,1,2,0,1,"
      "0,1\n";
  BPMS_EXPECT_ERROR(read_vectors(folder.write("v.csv", bad)), bad_input, "not positive semi-definite");
}

}  // namespace
}  // namespace bpms
