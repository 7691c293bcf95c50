/* Reads the positions of the curves of a .nid file: a grid (SpecMapTable) or a list
 * (SpecPosTable).
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/nid/nid.h"

#include "core/base/number.h"

#include <math.h>
#include <string.h>

#define MAP_SECTION "DataSet\\SpecInfos\\SpecMapTable"
#define POSITION_SECTION "DataSet\\SpecInfos\\SpecPosTable"

/* The entry Map0 = x0;x1;y0;y1;columns;rows;rotation;placement. */
typedef struct nid_map {
    double x0, x1, y0, y1, rotation;
    long columns, rows;
} nid_map;

static double parse_list_number(const char *list, size_t i)
{
    char item[NID_TEXT];
    return nid_list_item(list, ';', i, item, sizeof item) ? parse_number_or_nan(item) : (double)NAN;
}

static bool read_map(const nid_header *header, nid_map *map)
{
    const char *list = nid_get(header, MAP_SECTION, "Map0");
    if (list == NULL)
        return false;
    double columns = parse_list_number(list, 4), rows = parse_list_number(list, 5);
    if (!(columns >= 1 && columns <= 1e6 && rows >= 1 && rows <= 1e6))
        return false;
    *map = (nid_map){.x0 = parse_list_number(list, 0),
                     .x1 = parse_list_number(list, 1),
                     .y0 = parse_list_number(list, 2),
                     .y1 = parse_list_number(list, 3),
                     .rotation = parse_list_number(list, 6),
                     .columns = lround(columns),
                     .rows = lround(rows)};
    return true;
}

void nid_read_grid(const nid_header *header, long *columns, long *rows)
{
    nid_map map = {.columns = 0};
    (void)read_map(header, &map);
    *columns = map.columns;
    *rows = map.rows;
}

static double interpolate_grid(double first, double last, long i, long n)
{
    return n > 1 ? first + (last - first) * (double)i / (double)(n - 1) : first;
}

static void set_map_position(const nid_map *map, size_t i, const char *name, wt_log *log,
                             wt_force_curve *curve)
{
    if (!force_set_grid_position(map->columns, map->rows, true, i, curve)) {
        wt_log_add(log, WT_WARNING, name, MAP_SECTION,
                   "more curves than places in the map: place unknown");
        return;
    }
    if (map->rotation != 0) {
        wt_log_add(log, WT_WARNING, name, MAP_SECTION,
                   "the map is rotated, its unit is not known: positions left out");
        return;
    }
    curve->x = interpolate_grid(map->x0, map->x1, curve->grid_x, map->columns);
    curve->y = interpolate_grid(map->y0, map->y1, curve->grid_y, map->rows);
}

static double read_axis_factor(const nid_header *header, size_t axis)
{
    char unit[NID_TEXT];
    double factor = 1, offset = 0;
    const char *list = nid_get(header, POSITION_SECTION, "PosUnit");
    if (list == NULL)
        list = nid_get(header, POSITION_SECTION, "PosUnits");
    /* The list has one unit for all axes, or one for each. */
    if (list == NULL || (!nid_list_item(list, ';', axis, unit, sizeof unit) &&
                         !nid_list_item(list, ';', 0, unit, sizeof unit)))
        return (double)NAN;
    if (wt_unit_to_si(unit, WT_Q_LENGTH, &factor, &offset, NULL) != WT_OK)
        return (double)NAN;
    return factor;
}

static void set_listed_position(const nid_header *header, size_t i, const char *name, wt_log *log,
                                wt_force_curve *curve)
{
    char key[32], axis[NID_TEXT];
    snprintf(key, sizeof key, "Pos%zu", i);
    const char *list = nid_get(header, POSITION_SECTION, key);
    const char *axes = nid_get(header, POSITION_SECTION, "PosAxis");
    for (size_t a = 0; list != NULL && axes != NULL; a++) {
        if (!nid_list_item(axes, ';', a, axis, sizeof axis))
            break;
        double value = read_axis_factor(header, a) * parse_list_number(list, a);
        if (strcmp(axis, "X") == 0)
            curve->x = value;
        else if (strcmp(axis, "Y") == 0)
            curve->y = value;
    }
    if (isnan(curve->x) || isnan(curve->y))
        wt_log_add(log, WT_WARNING, name, POSITION_SECTION,
                   "no position for a curve that is not in the list");
}

void nid_set_position(const nid_header *header, size_t i, const char *name, wt_log *log,
                      wt_force_curve *curve)
{
    nid_map map;
    if (read_map(header, &map))
        set_map_position(&map, i, name, log, curve);
    else if (nid_get(header, POSITION_SECTION, "Count") != NULL)
        set_listed_position(header, i, name, log, curve);
}
