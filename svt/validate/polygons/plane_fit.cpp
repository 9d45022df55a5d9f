#include <svt/validate/polygons/plane_fit.hpp>

#include <utility>

namespace svt::validate {
namespace {

// Turns the axes p and q of a symmetric matrix so that its element there becomes 0.
void rotate(double (&m)[3][3], double (&axes)[3][3], int p, int q) noexcept {
    if (m[p][q] == 0) return;
    const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
    const double t = (theta >= 0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1));
    const double c = 1 / std::sqrt(t * t + 1), s = t * c;
    for (int k = 0; k < 3; ++k) {
        const double a = m[k][p], b = m[k][q];
        m[k][p] = c * a - s * b;
        m[k][q] = s * a + c * b;
    }
    for (int k = 0; k < 3; ++k) {
        const double a = m[p][k], b = m[q][k];
        m[p][k] = c * a - s * b;
        m[q][k] = s * a + c * b;
        const double u = axes[k][p], v = axes[k][q];
        axes[k][p] = c * u - s * v;
        axes[k][q] = s * u + c * v;
    }
}

}  // namespace

PlaneFit fitPlane(std::span<const Vec3d> points) noexcept {
    PlaneFit fit;
    // Twice: the second round recovers the precision that the sum of large coordinates loses.
    fit.center = points.front();
    for (int round = 0; round < 2; ++round) {
        Vec3d sum{};
        for (const Vec3d& p : points) sum = sum + (p - fit.center);
        fit.center = fit.center + sum / static_cast<double>(points.size());
    }
    double m[3][3] = {}, axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const Vec3d& p : points) {
        const Vec3d d = p - fit.center;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) m[i][j] += d[i] * d[j];
    }
    constexpr int kSweeps = 12;  // each squares the error; six reach double precision
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        rotate(m, axes, 0, 1);
        rotate(m, axes, 0, 2);
        rotate(m, axes, 1, 2);
    }
    int least = 0, most = 0;
    for (int i = 1; i < 3; ++i) {
        if (m[i][i] < m[least][least]) least = i;
        if (m[i][i] > m[most][most]) most = i;
    }
    if (least == most) most = (least + 1) % 3;
    fit.normal = normalized(Vec3d{axes[0][least], axes[1][least], axes[2][least]});
    fit.along = normalized(Vec3d{axes[0][most], axes[1][most], axes[2][most]});
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3d d = points[i] - fit.center;
        const double away = std::abs(dot(d, fit.normal));
        if (away > fit.thickness) {
            fit.thickness = away;
            fit.farthest = i;
        }
        fit.width = std::max(fit.width, length(d - fit.along * dot(d, fit.along)));
    }
    return fit;
}

}  // namespace svt::validate
