#include "planner/mesh/cloud.hpp"
#include "planner/mesh/solid_sampling.hpp"

namespace aerogram::planner {

double mean_distance(const TriangleMesh& mesh, const Points& points) {
    return mean_distance(cloud_of(mesh, pieces_for(points.size()), {}), points);
}

double mean_distance(const TetrahedralMesh& inside, const Points& points) {
    return mean_distance(cloud_of(inside, pieces_for(points.size()), {}), points);
}

}  // namespace aerogram::planner
