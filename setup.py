"""The Python package of python/contact_path, for catkin alone; scripts/python needs nothing of it."""
from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import find_packages, setup

PACKAGES = find_packages('python')

setup(**generate_distutils_setup(packages=PACKAGES, package_dir={'': 'python'},
                                 package_data={'contact_path': ['py.typed'], 'contact_path.page': ['web/*']}))
