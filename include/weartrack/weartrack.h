/* weartrack - all public headers. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_WEARTRACK_H
#define WEARTRACK_WEARTRACK_H

#include "weartrack/base.h"
#include "weartrack/data.h"
#include "weartrack/fit.h"
#include "weartrack/flow.h"
#include "weartrack/kernel.h"
#include "weartrack/model.h"
#include "weartrack/read.h"
#include "weartrack/report.h"

#endif
