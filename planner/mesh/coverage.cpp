#include "planner/mesh/cloud.hpp"
#include "planner/mesh/solid_sampling.hpp"

namespace aerogram::planner {

double mean_distance(const TriangleMesh& mesh, const Points& points, const DensityField& density) {
    return mean_distance(cloud_of(mesh, pieces_for(points.size()), density), points);
}

double mean_distance(const TetrahedralMesh& inside, const Points& points, const DensityField& density) {
    return mean_distance(cloud_of(inside, pieces_for(points.size()), density), points);
}

}  // namespace aerogram::planner
