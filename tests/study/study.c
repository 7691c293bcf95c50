/* Coverage of stated intervals. The program draws data sets from a known truth, passes them to the
 * command as a user would, and counts the intervals that contain the truth: study --program
 * WEARTRACK [--draws N] [--seed S] [--scenes REGEX] [--threads N] [--keep FOLDER] Tables go to
 * standard output. The exit status is 1 if a promised scene or the command fails.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "afm_observe.h"
#include "collection_observe.h"
#include "dma_observe.h"
#include "growth_observe.h"
#include "identify_observe.h"
#include "lever_observe.h"
#include "record_observe.h"
#include "surface_observe.h"
#include "tally.h"
#include "thickness_observe.h"
#include "track_observe.h"
#include "validation_observe.h"

#include <math.h>
#include <pthread.h>
#include <regex.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define THREADS_MAX 64

typedef struct options {
    stage stage;
    int draws, threads;
    regex_t scenes;
} options;

/* A selected scene and its draws. */
typedef struct job {
    const family *family;
    int scene;
    const facts *facts;
    void *prepared;
    draw *draws;
} job;

typedef struct work {
    const options *options;
    job *jobs;
    int n_jobs;
    atomic_int next; /* index of a draw over all jobs */
} work;

static void *run_worker(void *argument)
{
    work *w = argument;
    const int draws = w->options->draws;
    for (int k; (k = atomic_fetch_add(&w->next, 1)) < w->n_jobs * draws;) {
        job *j = &w->jobs[k / draws];
        model_variant_fit(j->family, j->scene, j->prepared, &w->options->stage, k % draws,
                          &j->draws[k % draws]);
    }
    return NULL;
}

static void run_workers(work *w)
{
    pthread_t threads[THREADS_MAX];
    int started = 0;
    for (int i = 1; i < w->options->threads && started < THREADS_MAX; i++)
        started += pthread_create(&threads[started], NULL, run_worker, w) == 0;
    run_worker(w);
    for (int i = 0; i < started; i++)
        pthread_join(threads[i], NULL);
}

static void make_job(const family *f, int scene, int draws, job *to)
{
    *to = (job){.family = f,
                .scene = scene,
                .facts = f->facts(scene),
                .prepared = f->prepare(scene),
                .draws = calloc((size_t)draws, sizeof *to->draws)};
    if (to->draws == NULL)
        abort();
}

/* Creates the jobs of the selected scenes; returns their number. */
static int make_jobs(const options *o, const family *families, int n_families, job **to)
{
    int n = 0, all = 0;
    for (int f = 0; f < n_families; f++)
        all += families[f].n;
    *to = calloc((size_t)all, sizeof **to);
    if (*to == NULL)
        abort();
    for (int f = 0; f < n_families; f++)
        for (int i = 0; i < families[f].n; i++)
            if (regexec(&o->scenes, families[f].facts(i)->name, 0, NULL, 0) == 0)
                make_job(&families[f], i, o->draws, &(*to)[n++]);
    return n;
}

static void print_number(double x)
{
    if (isnan(x))
        printf("\t-");
    else
        printf("\t%.3g", x);
}

static void print_tally(const job *j, quantity q, int draws)
{
    const tally t = tally_make(j->draws, draws, q);
    given g = {.coverage = (double)NAN, .half_width = (double)NAN};
    if (t.draws == 0)
        return;
    for (int i = 0; i < GIVEN_MAX; i++)
        if (j->facts->given[i].coverage > 0 && j->facts->given[i].quantity == q)
            g = j->facts->given[i];
    printf("%s\t%s\t%d\t%.3g", j->facts->name, quantities[q].name, t.draws, t.stated);
    print_number(100 * t.coverage);
    print_number(100 * t.error);
    print_number(t.half_width);
    print_number(t.rms);
    print_number(t.half_width / (1.96 * t.rms));
    print_number(t.rms_stated);
    print_number(g.coverage);
    print_number(g.half_width);
    printf("\t%s\n", j->facts->intervals_promised ? "yes" : "no");
}

static void print_verdicts(const job *j, int draws)
{
    const verdict_tally t = tally_verdicts(j->facts, j->draws, draws);
    const int wrong = t.draws - t.right -
                      (j->facts->right & RIGHT(INCONCLUSIVE) ? 0 : t.said[INCONCLUSIVE]) -
                      t.said[NO_VERDICT];
    const char *words = "";
    for (int i = draws - 1; i >= 0; i--)
        if (j->draws[i].words[0] != '\0')
            words = j->draws[i].words;
    printf("%s\t%s\t%d\t%d\t%d\t%d\t%d\t%d\t%d\t%d\t%d\t%.2g\t%s\t%s\n", j->facts->name,
           j->facts->about, t.draws, t.right, wrong, t.said[YES], t.said[NO], t.said[INCONCLUSIVE],
           t.outcomes[OUTCOME_REFUSED], t.outcomes[OUTCOME_BROKEN], t.wrong_yes, t.seconds,
           j->facts->verdict_promised ? "yes" : "no", words);
}

static int print(const work *w)
{
    const int draws = w->options->draws;
    int complaints = 0;
    pooled_tally together = {.verdicts = 0};
    printf("scene\tquantity\tdraws\tstated\tcoverage\tbinomial_error\thalf_width\ttrue_rms\t"
           "half_over_1.96_rms\trms_over_stated\tgiven_coverage\tgiven_half_width\tpromised\n");
    for (int i = 0; i < w->n_jobs; i++)
        for (quantity q = 0; q < Q_COUNT; q++)
            print_tally(&w->jobs[i], q, draws);
    printf("\nscene\tabout\tdraws\tright\twrong\tyes\tno\tcannot_say\trefused\tbroken\t"
           "wrong_yes\tseconds\tpromised\tfirst_error\n");
    for (int i = 0; i < w->n_jobs; i++)
        print_verdicts(&w->jobs[i], draws);
    for (int i = 0; i < w->n_jobs; i++) {
        const job *j = &w->jobs[i];
        const verdict_tally t = tally_verdicts(j->facts, j->draws, draws);
        complaints += tally_complaints(j->facts, j->draws, draws, stderr);
        tally_add(j->facts, j->draws, draws, &together);
        if (t.outcomes[OUTCOME_BROKEN] > 0) {
            fprintf(stderr, "%s: the command broke in %d of %d draws\n", j->facts->name,
                    t.outcomes[OUTCOME_BROKEN], draws);
            complaints++;
        }
    }
    return complaints + tally_pool_complaints(&together, stderr);
}

static int usage(const char *what)
{
    fprintf(stderr,
            "study: %s\nusage: study --program WEARTRACK [--draws N] [--seed S] [--scenes REGEX]\n"
            "             [--threads N] [--keep FOLDER]\n",
            what);
    return 2;
}

static int positive(const char *text)
{
    char *end;
    const long value = strtol(text, &end, 10);
    return *end == '\0' && value > 0 && value <= 1000000 ? (int)value : 0;
}

/* Returns 0 or the exit status. */
static int read_options(int argc, char **argv, options *o)
{
    const char *scenes_wanted = ".";
    *o = (options){.stage = {.seed = 1}, .draws = 200, .threads = 1};
    for (int i = 1; i < argc; i += 2) {
        const char *name = argv[i], *value = i + 1 < argc ? argv[i + 1] : NULL;
        if (value == NULL)
            return usage("an option lacks its value");
        if (strcmp(name, "--program") == 0)
            o->stage.program = value;
        else if (strcmp(name, "--draws") == 0)
            o->draws = positive(value);
        else if (strcmp(name, "--seed") == 0)
            o->stage.seed = strtoull(value, NULL, 10);
        else if (strcmp(name, "--scenes") == 0)
            scenes_wanted = value;
        else if (strcmp(name, "--threads") == 0)
            o->threads = positive(value);
        else if (strcmp(name, "--keep") == 0)
            o->stage.folder = value;
        else
            return usage("an option that is not known");
    }
    if (o->stage.program == NULL || o->draws == 0 || o->threads == 0)
        return usage("--program is missing, or a number is not good");
    if (regcomp(&o->scenes, scenes_wanted, REG_EXTENDED | REG_NOSUB) != 0)
        return usage("--scenes is no regular expression");
    o->stage.keep = o->stage.folder != NULL;
    return 0;
}

int main(int argc, char **argv)
{
    options o;
    char made[] = "/tmp/weartrack-study-XXXXXX";
    const int bad = read_options(argc, argv, &o);
    if (bad != 0)
        return bad;
    if (!o.stage.keep && (o.stage.folder = mkdtemp(made)) == NULL)
        return usage("no folder to work in");
    const family families[] = {dma_family(),        track_family(),    afm_family(),
                               lever_family(),      surface_family(),  record_family(),
                               validation_family(), identify_family(), collection_family(),
                               growth_family(),     thickness_family()};
    job *jobs = NULL;
    const int n = make_jobs(&o, families, sizeof families / sizeof families[0], &jobs);
    work w = {.options = &o, .jobs = jobs, .n_jobs = n};
    run_workers(&w);
    const int complaints = w.n_jobs > 0 ? print(&w) : usage("no scene has such a name");
    for (int i = 0; i < w.n_jobs; i++) {
        free(jobs[i].draws);
        free(jobs[i].prepared);
    }
    free(jobs);
    regfree(&o.scenes);
    if (!o.stage.keep)
        rmdir(made);
    return complaints > 0;
}
