"""Pages for browsers of paths and studies, and in web/ what they are made of."""
