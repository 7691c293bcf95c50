/* Adhesive contact of any convex tip, a generalisation of Johnson, Kendall and Roberts, Proc. R.
 * Soc. Lond. A 324 (1971) 301. The contact without adhesion has the contact radius a, depth delta0
 * and force F0. With s = sqrt(2 pi w / E*) the branch of least energy is
 *
 *     delta = delta0 - s sqrt(a),   F = F0 - 2 E* s a^(3/2).
 *
 * delta0 is the parameter of this branch. The contact table has F0, dF0/ddelta0 = 2 E* a and its
 * derivative. The contact radius of a pyramid is that of the circle with its mean distances. The
 * edge of a pyramid is longer, and the work of adhesion includes that error.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/law/adhesion.h"

#include "core/math/root.h"
#include "core/math/simd.h"
#include "indentation/law/tip.h"

#include <float.h>
#include <math.h>

/* Range of atomic forces [m], an interatomic distance, in Tabor's parameter (J. Colloid Interface
 * Sci. 58 (1977) 2). The transition between the regimes takes some decades. */
static const double force_range = 0.3e-9;
/* Search range of the work of adhesion [J/m^2]. Surfaces have 1e-3 to 1; welded surfaces are no
 * contact. */
static const double min_work = 1e-9, max_work = 1e3;
/* Bisection needs about 60 steps, and false position about 10, to the last digit of a double. */
/* Relative step of the bare depth at convergence. The remaining error is of the order of its
 * square. */
static const double close_step = 1e-7;
enum {
    MAX_ROUNDS = 200,
    MAX_STEPS = 600,               /* factors of 4; more than the range of a double */
    CORNER_NODES = ADHESION_BLOCK, /* grid for the end of the branch near a corner */
    NODES = 64, /* nodes of the branch; interpolation between them is accurate to 1e-7 */
    BLOCK = ADHESION_BLOCK,
};

bool adhesion_applies(const wt_tip *tip)
{
    return tip->shape != WT_TIP_PUNCH;
}

/* Contact without adhesion at several bare depths. Each determines a point of the branch. */
typedef struct bare_contacts {
    double g[BLOCK], slope[BLOCK], curvature[BLOCK];
} bare_contacts;

static void bare_contact_values(const adhesion *law, const double *bare, size_t n,
                                bare_contacts *to)
{
    contact_table_values(law->table, bare, n, to->g, to->slope, to->curvature);
}

static double adhesion_prefactor(const adhesion *law)
{
    return sqrt(2.0 * M_PI * law->work / law->reduced);
}

WIDE_REGISTERS void adhesion_contacts(const adhesion *law, const double *bare, size_t n,
                                      adhesive_contacts *to)
{
    bare_contacts v;
    const double e = law->reduced, pull = adhesion_prefactor(law);
    bare_contact_values(law, bare, n, &v);
    for (size_t i = 0; i < n; i++) {
        const double a = 0.5 * v.slope[i], root = sqrt(a), fall = pull * root,
                     q = 0.25 * pull * v.curvature[i] / root,
                     stiffness = 2.0 * e * a * (1.0 - 3.0 * q) / (1.0 - q);
        to->radius[i] = a;
        to->depth[i] = bare[i] - fall;
        to->force[i] = e * (v.g[i] - 2.0 * fall * a);
        to->stiffness[i] = stiffness;
        to->by_modulus[i] = v.g[i] - fall * a - stiffness * fall / (2.0 * e);
        to->by_work[i] = (0.5 * stiffness - e * a) * fall / law->work;
    }
}

adhesive_contact adhesion_contact_value(const adhesion *law, double bare)
{
    adhesive_contacts c;
    adhesion_contacts(law, &bare, 1, &c);
    return (adhesive_contact){c.radius[0],    c.depth[0],      c.force[0],
                              c.stiffness[0], c.by_modulus[0], c.by_work[0]};
}

/* ---- the end of the branch ------------------------------------------------------------------- */

typedef struct release_search {
    const adhesion *law;
    double k;
} release_search;

/* Stability of the branch against the cantilever at n points: (dF + k ddelta) along the branch over
 * the change of the bare depth, and over k if k is infinite. The branch is stable where the value
 * is positive. */
WIDE_REGISTERS static void branch_stabilities(const release_search *s, const double *bare, size_t n,
                                              double *to)
{
    bare_contacts v;
    const double e = s->law->reduced, pull = adhesion_prefactor(s->law), k = s->k;
    const bool fixed = isinf(k);
    bare_contact_values(s->law, bare, n, &v);
    for (size_t i = 0; i < n; i++) {
        const double a = 0.5 * v.slope[i], q = 0.25 * pull * v.curvature[i] / sqrt(a);
        to[i] = fixed ? 1.0 - q : 2.0 * e * a * (1.0 - 3.0 * q) + k * (1.0 - q);
    }
}

static double branch_stability(double bare, void *user)
{
    double value;
    branch_stabilities(user, &bare, 1, &value);
    return value;
}

static bool is_stable(release_search *s, double bare)
{
    return branch_stability(bare, s) > 0.0;
}

static double solve_branch_limit(release_search *s, double low, double high)
{
    double end = high;
    return root_find(branch_stability, s, low, high, 0.0, &end, NULL) == WT_OK ? end : (double)NAN;
}

/* Finds the end of the branch from any start. The function requires that the branch has one end. */
static double bracket_branch_limit(release_search *s, double bare)
{
    const bool inside = is_stable(s, bare);
    double next = bare;
    for (int i = 0; i < MAX_STEPS && is_stable(s, next) == inside; i++) {
        bare = next;
        next *= inside ? 0.25 : 4.0;
    }
    return inside ? solve_branch_limit(s, next, bare) : solve_branch_limit(s, bare, next);
}

/* Radius over the square root of the profile slope rises with the radius below a corner at radius
 * b, and above 2b. There it rises faster than the condition of the end, so there is one end.
 * Between b and 2b it falls just after the corner, and the branch is stable over a range there. */
double adhesion_release(const adhesion *law, double k)
{
    if (!(law->work > 0.0))
        return 0.0;
    release_search search = {law, k};
    const wt_tip *tip = contact_table_tip(law->table);
    const double corner = contact_switch_depth(tip);
    if (!(corner > 0.0) || isinf(corner))
        return bracket_branch_limit(&search, 1e-9);
    double top = corner;
    for (bare_contacts v = {.slope = {0.0}}; v.slope[0] < 4.0 * tip->transition_radius;
         bare_contact_values(law, &top, 1, &v))
        top *= 2.0;
    if (!is_stable(&search, top))
        return bracket_branch_limit(&search, top);
    double bare[CORNER_NODES + 1], force[CORNER_NODES];
    for (int i = 0; i <= CORNER_NODES; i++) {
        const double share = (double)i / CORNER_NODES;
        bare[i] = corner + share * share * (top - corner);
    }
    branch_stabilities(&search, bare, CORNER_NODES, force);
    for (int i = CORNER_NODES - 1; i > 0; i--)
        if (!(force[i] > 0.0))
            return solve_branch_limit(&search, bare[i], bare[i + 1]);
    return is_stable(&search, corner) ? bracket_branch_limit(&search, corner)
                                      : corner; /* below the corner, the end on the cap */
}

/* ---- equilibrium with a cantilever ----------------------------------------------------------- */

/* Computes the positions of the base at points of the branch, and their derivatives by the bare
 * depth. */
WIDE_REGISTERS static void base_positions(const adhesion *law, double k, const double *bare,
                                          size_t n, double *base, double *rise)
{
    bare_contacts v;
    const double pull = adhesion_prefactor(law), soft = law->reduced / k;
    bare_contact_values(law, bare, n, &v);
    for (size_t i = 0; i < n; i++) {
        const double a = 0.5 * v.slope[i], root = sqrt(a), fall = pull * root,
                     q = 0.25 * pull * v.curvature[i] / root;
        base[i] = bare[i] - fall + soft * (v.g[i] - 2.0 * fall * a);
        rise[i] = 1.0 - q + 2.0 * soft * a * (1.0 - 3.0 * q);
    }
}

static double base_position(const adhesion *law, double k, double bare)
{
    double base, rise;
    base_positions(law, k, &bare, 1, &base, &rise);
    return base;
}

/* Block of positions with their bare depths and brackets. */
typedef struct balance_block {
    double position[BLOCK], bare[BLOCK], low[BLOCK], high[BLOCK];
} balance_block;

WIDE_INLINE void select_lanes(wide *to, const wide_bits *which, const wide *one, const wide *other)
{
    *to = (wide)((*which & (wide_bits)*one) | (~*which & (wide_bits)*other));
}

/* Performs a Newton step, or a bisection step if the former leaves the bracket. Returns the largest
 * relative change of a bare depth. */
WIDE_REGISTERS static double newton_step_block(const adhesion *law, double k, balance_block *b)
{
    double base[BLOCK], rise[BLOCK], most = 0.0;
    wide largest = {0.0};
    base_positions(law, k, b->bare, BLOCK, base, rise);
    for (size_t i = 0; i < BLOCK; i += WIDE) {
        wide bare, low, high, at, excess, slope;
        simd_load(&bare, b->bare + i);
        simd_load(&low, b->low + i);
        simd_load(&high, b->high + i);
        simd_load(&at, b->position + i);
        simd_load(&excess, base + i);
        simd_load(&slope, rise + i);
        excess -= at;
        const wide_bits above = excess > 0.0;
        select_lanes(&low, &above, &low, &bare);
        select_lanes(&high, &above, &bare, &high);
        wide next = bare - excess / slope;
        const wide half = 0.5 * (low + high);
        const wide_bits inside = (next >= low) & (next <= high);
        select_lanes(&next, &inside, &next, &half);
        const wide share = (next - bare) / next, other = -share;
        wide_maximum(&largest, &share);
        wide_maximum(&largest, &other);
        simd_store(b->low + i, &low);
        simd_store(b->high + i, &high);
        simd_store(b->bare + i, &next);
    }
    for (size_t j = 0; j < WIDE; j++)
        most = largest[j] > most ? largest[j] : most;
    return most;
}

/* Nodes of the branch. For the interval after node j: the differences of bare depth and base, and
 * the difference between cubic and line at either end. */
typedef struct branch {
    double bare[NODES + 1], base[NODES + 1], rise[NODES + 1];
    double up[NODES], span[NODES], cubic_low[NODES], cubic_high[NODES];
} branch;

/* Samples the branch from its end to a position. At its end the position is quadratic in the bare
 * depth. */
static void sample_branch(const adhesion *law, double k, double release, double farthest,
                          branch *to)
{
    double top = release > 0.0 ? 2.0 * release : 1e-6 * farthest;
    while (base_position(law, k, top) < farthest)
        top *= 2.0;
    for (size_t j = 0; j <= NODES; j++) {
        const double share = (double)j / NODES;
        to->bare[j] = release + share * share * (top - release);
    }
    for (size_t j = 0; j <= NODES; j += BLOCK)
        base_positions(law, k, to->bare + j, j + BLOCK <= NODES ? BLOCK : NODES + 1 - j,
                       to->base + j, to->rise + j);
    for (size_t j = 0; j < NODES; j++) {
        to->up[j] = to->bare[j + 1] - to->bare[j];
        to->span[j] = to->base[j + 1] - to->base[j];
        to->cubic_low[j] = to->span[j] / to->rise[j] - to->up[j];
        to->cubic_high[j] = to->span[j] / to->rise[j + 1] - to->up[j];
    }
}

/* Interpolates points of the branch; node[j] is the last node below position j. The cubic uses the
 * slopes at the nodes. The interval at the end of the branch is linear, because its slope is
 * infinite. */
WIDE_REGISTERS static void interpolate_branch(const branch *nodes, const size_t node[BLOCK],
                                              balance_block *b)
{
    double part[6][BLOCK];
    for (size_t j = 0; j < BLOCK; j++) {
        const size_t at = node[j];
        b->low[j] = nodes->bare[at];
        b->high[j] = nodes->bare[at + 1];
        part[0][j] = nodes->up[at];
        part[1][j] = nodes->base[at];
        part[2][j] = nodes->span[at];
        part[3][j] = nodes->cubic_low[at];
        part[4][j] = nodes->cubic_high[at];
        part[5][j] = (double)at;
    }
    for (size_t i = 0; i < BLOCK; i += WIDE) {
        wide z, low, high, up, base, span, cubic_low, cubic_high, at;
        simd_load(&z, b->position + i);
        simd_load(&low, b->low + i);
        simd_load(&high, b->high + i);
        simd_load(&up, part[0] + i);
        simd_load(&base, part[1] + i);
        simd_load(&span, part[2] + i);
        simd_load(&cubic_low, part[3] + i);
        simd_load(&cubic_high, part[4] + i);
        simd_load(&at, part[5] + i);
        const wide t = (z - base) / span, u = 1.0 - t, line = low + up * t;
        wide interpolated = line + u * t * (u * cubic_low - t * cubic_high);
        const wide_bits cubic = (at > 0.0) & (interpolated > low) & (interpolated < high);
        select_lanes(&interpolated, &cubic, &interpolated, &line);
        simd_store(b->bare + i, &interpolated);
    }
}

void adhesion_balance(const adhesion *law, double k, double release, const double *position,
                      size_t n, double *bare)
{
    double farthest = -(double)INFINITY;
    for (size_t i = 0; i < n; i++)
        farthest = position[i] > farthest ? position[i] : farthest;
    const double held_position = release > 0.0 ? base_position(law, k, release) : 0.0;
    branch nodes;
    if (!(farthest > held_position)) { /* all positions are below the end of the branch */
        for (size_t i = 0; i < n; i++)
            bare[i] = release;
        return;
    }
    sample_branch(law, k, release, farthest, &nodes);
    size_t at = 0;
    for (size_t i = 0; i < n; i += BLOCK) {
        balance_block b;
        size_t node[BLOCK], n_held = 0;
        for (size_t j = 0; j < BLOCK; j++) {
            const double z = position[i + j < n ? i + j : n - 1];
            b.position[j] = z;
            n_held += !(z > held_position);
            while (at > 0 && z < nodes.base[at])
                at--;
            while (at + 2 <= NODES && !(z < nodes.base[at + 1]))
                at++;
            node[j] = at;
        }
        if (n_held < BLOCK)
            interpolate_branch(&nodes, node, &b);
        for (size_t j = 0; j < BLOCK && n_held > 0; j++)
            if (!(b.position[j] > held_position))
                b.bare[j] = b.low[j] = b.high[j] = release;
        for (int round = 0;
             n_held < BLOCK && round < MAX_ROUNDS && newton_step_block(law, k, &b) > close_step;
             round++) {
        }
        for (size_t j = 0; j < BLOCK && i + j < n; j++)
            bare[i + j] = b.bare[j];
    }
}

/* ---- work of adhesion ------------------------------------------------------------------------ */

/* Logarithm of the pull-off force. */
static double log_pull_off(const wt_contact_table *table, double reduced, double k, double log_work)
{
    const adhesion law = {table, reduced, exp(log_work)};
    return log(fmax(-adhesion_contact_value(&law, adhesion_release(&law, k)).force, DBL_MIN));
}

/* Factor around the work of a sphere with the same pull-off force that mostly holds the solution.
 */
static const double usual_factor = 3.0;

/* Solves with the Illinois variant of false position. The function is nearly linear in logarithms.
 */
double adhesion_work(const wt_contact_table *table, double reduced, double k, double pull_off)
{
    const wt_tip *tip = contact_table_tip(table);
    if (tip->shape == WT_TIP_PUNCH)
        return pull_off * pull_off / (8.0 * M_PI * reduced * pow(tip->radius, 3));
    const double target = log(pull_off), close = 1e-12;
    const double sphere = pull_off / (1.5 * M_PI * tip->radius);
    double low = log(fmin(fmax(sphere / usual_factor, min_work), max_work)),
           high = log(fmax(fmin(sphere * usual_factor, max_work), min_work));
    double below = log_pull_off(table, reduced, k, low) - target;
    double above = log_pull_off(table, reduced, k, high) - target;
    if (!(below < 0.0))
        below = log_pull_off(table, reduced, k, low = log(min_work)) - target;
    if (!(above > 0.0))
        above = log_pull_off(table, reduced, k, high = log(max_work)) - target;
    if (!(below < 0.0) || !(above > 0.0))
        return (double)NAN;
    for (int i = 0, side = 0; i < MAX_ROUNDS && high - low > close; i++) {
        const double middle = high - above * (high - low) / (above - below);
        const double deviation = log_pull_off(table, reduced, k, middle) - target;
        const int now = deviation > 0.0 ? 1 : -1;
        if (fabs(deviation) < close)
            return exp(middle);
        if (deviation > 0.0) {
            high = middle;
            above = deviation;
            below *= side == now ? 0.5 : 1.0;
        } else {
            low = middle;
            below = deviation;
            above *= side == now ? 0.5 : 1.0;
        }
        side = now;
    }
    return exp(0.5 * (low + high));
}

double adhesion_tabor(const adhesion *law)
{
    const wt_tip *tip = contact_table_tip(law->table);
    if (tip->shape == WT_TIP_CONE || tip->shape == WT_TIP_PUNCH || !(tip->radius > 0.0))
        return (double)NAN;
    const double x = law->work / law->reduced;
    return cbrt(tip->radius * x * x / (force_range * force_range * force_range));
}
