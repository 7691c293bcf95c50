/* The general construction behind Johnson, Kendall and Roberts, Proc. R. Soc. Lond. A 324 (1971)
 * 301: with the contact radius a, depth delta0 and force F0 of the contact without adhesion and
 * s = sqrt(2 pi w / E*),
 *
 *   delta = delta0 - s sqrt(a),   F = F0 - 2 E* s a^(3/2),
 *
 * is the least energy for any convex tip. The pyramid's a is that of the circle with its mean
 * distances; its edge is longer, and the work of adhesion carries that error.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "model/adhesion.h"
#include "model/root.h"
#include "model/tip.h"

#include <float.h>
#include <math.h>

/* Range of atomic forces [m], an interatomic distance, in Tabor's parameter (J. Colloid Interface
 * Sci. 58 (1977) 2): it names the regime, which goes over some decades. */
static const double force_range = 0.3e-9;
/* The steps in which the end of the branch is looked for, before it is found by halves: the branch
 * has one end, which no step jumps over twice. 3000 of them are 40 decades. */
static const double radius_step = 0.97;
enum { MAX_STEPS = 3000 };
/* Between them a work of adhesion is looked for [J/m^2]: surfaces have 1e-3 to 1, and welded ones
 * are no contact; beyond there is none. */
static const double least_work = 1e-9, most_work = 1e3;
/* Halves and false positions to the last digit of a double need some 60 and 10. */
enum { MAX_ROUNDS = 200 };

bool adhesion_applies(const wt_tip *tip)
{
    return tip->shape != WT_TIP_PUNCH && !(tip->sample_thickness > 0.0);
}

adhesive_contact adhesion_at(const adhesion *law, double a)
{
    const contact_radius_values v = contact_at_radius(law->tip, a);
    const double e = law->reduced, s = sqrt(2.0 * M_PI * law->work / e), root = sqrt(a);
    const double pull = s * a * root, q = s / (2.0 * root);
    adhesive_contact c = {.depth = v.depth - s * root, .force = e * (v.g - 2.0 * pull)};
    c.stiffness = 2.0 * e * a * (isinf(v.slope) ? 1.0 : (v.slope - 3.0 * q) / (v.slope - q));
    c.by_modulus = v.g - pull - c.stiffness * s * root / (2.0 * e);
    c.by_work = (0.5 * c.stiffness * s * root - e * pull) / law->work;
    return c;
}

/* Rises where the branch is stable against the lever: dF/da + k ddelta/da, over k if k > 1. */
static double restoring_slope(const adhesion *law, double k, double a)
{
    const double slope = contact_at_radius(law->tip, a).slope;
    const double q = sqrt(2.0 * M_PI * law->work / law->reduced) / (2.0 * sqrt(a));
    const double sample = 2.0 * law->reduced * a * (slope - 3.0 * q), lever = slope - q;
    return isinf(k) || isinf(slope) ? lever : sample + k * lever;
}

typedef struct release_search {
    const adhesion *law;
    double k;
} release_search;

static bool comes_off(double a, void *user)
{
    const release_search *s = user;
    return !(restoring_slope(s->law, s->k, a) > 0.0);
}

double adhesion_release(const adhesion *law, double k)
{
    if (!(law->work > 0.0))
        return 0.0;
    /* From where adhesion no longer matters, past the corner, which is stable for a stretch. */
    const double far = 100.0 * sqrt(2.0 * M_PI * law->work / law->reduced);
    double a = 1e-9;
    if (law->tip->shape == WT_TIP_BLUNTED_PYRAMID)
        a = fmax(a, 2.0 * law->tip->transition_radius);
    while (contact_at_radius(law->tip, a).slope * sqrt(a) < far)
        a *= 2.0;
    double high = a;
    for (int i = 0; i < MAX_STEPS && restoring_slope(law, k, a) > 0.0; i++) {
        high = a;
        a *= radius_step;
    }
    double low = a;
    /* The sign changes in a root, or by a jump at the corner of the tip. */
    const double corner = law->tip->shape == WT_TIP_CONE ? 0.0 : law->tip->transition_radius;
    if (corner >= low && corner < high && !(restoring_slope(law, k, corner) > 0.0) &&
        restoring_slope(law, k, corner * (1.0 + 1e-12)) > 0.0)
        return corner;
    release_search search = {law, k};
    root_halve(comes_off, &search, &low, &high, 2.0 * DBL_EPSILON, MAX_ROUNDS);
    return 0.5 * (low + high);
}

/* Where the base of the lever is; infinite for a radius that the tip does not have. */
static double base_at(const adhesion *law, double k, double a)
{
    const adhesive_contact c = adhesion_at(law, a);
    return isinf(c.depth) ? c.depth : c.depth + c.force / k;
}

double adhesion_radius(const adhesion *law, double k, double position, double release, double start)
{
    double low = release, high = fmax(start, fmax(2.0 * low, 1e-12));
    if (release > 0.0 && position <= base_at(law, k, release))
        return release;
    for (; base_at(law, k, high) < position; high *= 2.0)
        low = high;
    double a = start > low && start < high ? start : high;
    for (int i = 0; i < MAX_ROUNDS; i++) {
        const double excess = base_at(law, k, a) - position;
        if (excess > 0.0)
            high = a;
        else
            low = a;
        double next = a - excess * (isinf(k) ? 1.0 : k) / restoring_slope(law, k, a);
        if (!(next > low && next < high))
            next = 0.5 * (low + high);
        if (fabs(next - a) <= 4.0 * DBL_EPSILON * a || !(high - low > 2.0 * DBL_EPSILON * high))
            return next;
        a = next;
    }
    return a;
}

/* ln of the force at which it comes off. */
static double log_pull_off(const wt_tip *tip, double reduced, double k, double log_work)
{
    const adhesion law = {tip, reduced, exp(log_work)};
    return log(fmax(-adhesion_at(&law, adhesion_release(&law, k)).force, DBL_MIN));
}

/* By the false position of Illinois: in logarithms it is close to a line. */
double adhesion_work(const wt_tip *tip, double reduced, double k, double pull_off)
{
    if (tip->sample_thickness > 0.0)
        return (double)NAN;
    if (tip->shape == WT_TIP_PUNCH)
        return pull_off * pull_off / (8.0 * M_PI * reduced * pow(tip->radius, 3));
    const double wanted = log(pull_off), close = 1e-12;
    double low = log(least_work), high = log(most_work);
    double below = log_pull_off(tip, reduced, k, low) - wanted;
    double above = log_pull_off(tip, reduced, k, high) - wanted;
    if (!(below < 0.0) || !(above > 0.0))
        return (double)NAN;
    for (int i = 0, side = 0; i < MAX_ROUNDS && high - low > close; i++) {
        const double middle = high - above * (high - low) / (above - below);
        const double off = log_pull_off(tip, reduced, k, middle) - wanted;
        const int now = off > 0.0 ? 1 : -1;
        if (fabs(off) < close)
            return exp(middle);
        if (off > 0.0) {
            high = middle;
            above = off;
            below *= side == now ? 0.5 : 1.0;
        } else {
            low = middle;
            below = off;
            above *= side == now ? 0.5 : 1.0;
        }
        side = now;
    }
    return exp(0.5 * (low + high));
}

double adhesion_tabor(const adhesion *law)
{
    if (law->tip->shape == WT_TIP_CONE || law->tip->shape == WT_TIP_PUNCH ||
        !(law->tip->radius > 0.0))
        return (double)NAN;
    const double x = law->work / law->reduced;
    return cbrt(law->tip->radius * x * x / (force_range * force_range * force_range));
}
