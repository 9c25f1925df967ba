"""Geometry of the pan/tilt camera turret on the greenhouse rail.

Standard DH of the two joints (theta, d, a, alpha), metres and radians:

    pan  | pan  | 0.31 | 0.04 | pi/2
    tilt | tilt | 0    | 0.09 | 0

The lens sits in the origin of the tilt frame and looks along its x axis.
"""
import numpy as np
from numpy import cos, sin, arctan2, sqrt, pi


def lens(pan, tilt):
    """position of the lens on the rail frame"""
    reach = 0.04 + 0.09*cos(tilt)
    x = reach*cos(pan)
    y = reach*sin(pan)
    z = 0.31 + 0.09*sin(tilt)
    return x, y, z


def gaze(pan, tilt):
    """unit vector of the optical axis"""
    gx = cos(pan)*cos(tilt)
    gy = sin(pan)*cos(tilt)
    gz = sin(tilt)
    return gx, gy, gz


def up(pan, tilt):
    """image 'up' (y axis of the tilt frame)"""
    ux = -cos(pan)*sin(tilt)
    uy = -sin(pan)*cos(tilt)
    uz = cos(tilt)
    return ux, uy, uz


def from_lens(x, y, z):
    """joint angles from a lens position (front half: tilt between -90 and 90 degrees)"""
    pan = arctan2(y, x)
    tilt = arctan2(z - 0.31, sqrt(x**2 + y**2) - 0.04)
    return pan, tilt


def from_gaze(gx, gy, gz):
    pan = arctan2(gy, gx)
    tilt = arctan2(gz, sqrt(gx**2 + gy**2))
    return pan, tilt


def lens_rates(pan, tilt, pan_rate, tilt_rate):
    vx = -(0.04 + 0.09*cos(tilt))*sin(pan)*pan_rate - 0.09*sin(tilt)*cos(pan)*tilt_rate
    vy = (0.04 + 0.09*cos(tilt))*cos(pan)*pan_rate - 0.09*sin(tilt)*sin(pan)*tilt_rate
    vz = -0.09*cos(tilt)*tilt_rate
    return vx, vy, vz
